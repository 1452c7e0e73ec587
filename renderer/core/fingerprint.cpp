#include "renderer/core/fingerprint.h"

#include <array>
#include <cstring>
#include <elf.h>
#include <link.h>
#include <span>
#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#else
#include <sys/utsname.h>
#endif

namespace gnomon {
namespace {

std::string hexOf(std::span<const unsigned char> bytes) {
  std::string hex;
  for (const unsigned char byte : bytes) {
    hex += "0123456789abcdef"[byte >> 4];
    hex += "0123456789abcdef"[byte & 15];
  }
  return hex;
}

std::size_t padded(std::size_t size) {
  return (size + 3) & ~std::size_t{3};
}

/// The build id among the notes of a PT_NOTE segment; empty when it isn't there.
std::string buildIdAmong(std::span<const unsigned char> notes) {
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) header;
    std::memcpy(&header, notes.data(), sizeof header);
    notes = notes.subspan(sizeof header);
    const std::size_t name = padded(header.n_namesz);
    const std::size_t size = padded(header.n_descsz);
    if (notes.size() < name + size) return {};
    if (header.n_type == NT_GNU_BUILD_ID && header.n_namesz == 4 && std::memcmp(notes.data(), "GNU", 4) == 0) {
      return hexOf(notes.subspan(name, header.n_descsz));
    }
    notes = notes.subspan(name + size);
  }
  return {};
}

/// A loaded object that is looked for, and its build id once it is found.
struct Search {
  std::string_view library; ///< first characters of its file's name; empty = the object that this code is in
  std::string id{};
};

bool isNamed(const dl_phdr_info& object, std::string_view library) {
  const std::string_view path = object.dlpi_name ? object.dlpi_name : "";
  return path.substr(path.rfind('/') + 1).starts_with(library);
}

bool holds(const dl_phdr_info& object, ElfW(Addr) address) {
  for (const ElfW(Phdr) & header : std::span(object.dlpi_phdr, object.dlpi_phnum)) {
    const ElfW(Addr) start = object.dlpi_addr + header.p_vaddr;
    if (header.p_type == PT_LOAD && address >= start && address < start + header.p_memsz) return true;
  }
  return false;
}

/// Called for each loaded object until it gives 1.
int visit(dl_phdr_info* object, std::size_t, void* target) {
  Search& search = *static_cast<Search*>(target);
  const bool found =
      search.library.empty() ? holds(*object, reinterpret_cast<ElfW(Addr)>(&visit)) : isNamed(*object, search.library);
  if (!found) return 0;
  for (const ElfW(Phdr) & header : std::span(object->dlpi_phdr, object->dlpi_phnum)) {
    if (header.p_type != PT_NOTE || !search.id.empty()) continue;
    search.id =
        buildIdAmong({reinterpret_cast<const unsigned char*>(object->dlpi_addr + header.p_vaddr), header.p_memsz});
  }
  return 1;
}

} // namespace

std::string buildId(std::string_view library) {
  Search search{library};
  dl_iterate_phdr(visit, &search);
  return search.id;
}

std::string cpuMake() {
#if defined(__x86_64__) || defined(__i386__)
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (__get_cpuid(0, &a, &b, &c, &d) == 0) return "x86";
  char vendor[12];
  std::memcpy(vendor, &b, 4);
  std::memcpy(vendor + 4, &d, 4);
  std::memcpy(vendor + 8, &c, 4);
  unsigned family = 0;
  bool sse42 = false;
  if (__get_cpuid(1, &a, &b, &c, &d) != 0) {
    family = a >> 8 & 15u;
    if (family == 15) family += a >> 20 & 255u;
    sse42 = (c & bit_SSE4_2) != 0;
  }
  return std::string(vendor, sizeof vendor) + " " + std::to_string(family) + (sse42 ? " sse4.2" : "");
#else
  utsname name{};
  uname(&name);
  return name.machine;
#endif
}

std::string cpuName() {
#if defined(__x86_64__) || defined(__i386__)
  constexpr unsigned kFirst = 0x80000002u, kLast = 0x80000004u;
  if (static_cast<unsigned>(__get_cpuid_max(0x80000000u, nullptr)) < kLast) return {};
  std::array<unsigned, 12> words{};
  for (unsigned leaf = kFirst; leaf <= kLast; ++leaf) {
    unsigned* at = &words[4 * (leaf - kFirst)];
    __get_cpuid(leaf, at, at + 1, at + 2, at + 3);
  }
  const std::string name(reinterpret_cast<const char*>(words.data()), sizeof words);
  const std::string_view trimmed = std::string_view(name).substr(0, name.find('\0'));
  const std::size_t first = trimmed.find_first_not_of(' ');
  return first == std::string_view::npos
             ? ""
             : std::string(trimmed.substr(first, trimmed.find_last_not_of(' ') + 1 - first));
#else
  return {};
#endif
}

std::string fingerprintOf(const RendererInfo& info) {
  std::uint64_t hash = 0xcbf29ce484222325u; // FNV-1a, 64 bits
  for (const std::string& part : {info.renderer, info.version, cpuMake(), std::string(GNOMON_VERSION), buildId(),
                                  buildId("libisal.so"), buildId("libdeflate.so")}) {
    for (const char c : part + '\n') hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  }
  std::string hex;
  for (int shift = 60; shift >= 0; shift -= 4) hex += "0123456789abcdef"[hash >> shift & 15u];
  return hex;
}

} // namespace gnomon
