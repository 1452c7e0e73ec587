// Read by the leak sanitizer; nothing in an ordinary build.

extern "C" const char* __lsan_default_suppressions();

/// libOSMesa keeps 160 bytes of each context and its driver's tables.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa.so\n";
}
