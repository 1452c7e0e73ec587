# Writes OUTPUT, a C++ source that defines gnomon::webFiles() from the files in FILES (names relative to SOURCE_DIR).
# Run as: cmake -DOUTPUT=... -DSOURCE_DIR=... -DFILES=a,b,c -P embed_files.cmake

# Without indentation, lines that only comment and a style's spaces: a sixth less for browsers to fetch.
function(slim variable)
  string(REGEX REPLACE "(^|\n)[ \t]+" "\\1" text "${${variable}}")
  if(name MATCHES "\\.mjs$")
    string(REGEX REPLACE "(^|\n)//[^\n]*" "\\1" text "${text}")
  endif()
  if(name MATCHES "\\.css$")
    string(REGEX REPLACE "(^|\n)/\\*[^*]*\\*/" "\\1" text "${text}")
    string(REGEX REPLACE "([;:,{]) +" "\\1" text "${text}")
    string(REGEX REPLACE " +{" "{" text "${text}")
  endif()
  string(REGEX REPLACE "\n\n+" "\n" text "${text}")
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

string(REPLACE "," ";" FILES "${FILES}")
set(arrays "")
set(rows "")
set(index 0)
foreach(name IN LISTS FILES)
  get_filename_component(extension ${name} LAST_EXT)
  if(extension STREQUAL ".html")
    set(type "text/html; charset=utf-8")
  elseif(extension STREQUAL ".css")
    set(type "text/css; charset=utf-8")
  elseif(extension STREQUAL ".mjs")
    set(type "text/javascript; charset=utf-8")
  elseif(extension STREQUAL ".svg")
    set(type "image/svg+xml")
  else()
    message(FATAL_ERROR "${name}: no content type is known for ${extension}")
  endif()
  set(path "/${name}")
  if(name STREQUAL "index.html")
    set(path "/")
  endif()
  file(READ ${SOURCE_DIR}/${name} text)
  slim(text)
  string(HEX "${text}" hex)
  string(REGEX REPLACE "(................................)" "\\1\n" hex "${hex}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND arrays "constexpr unsigned char kFile${index}[] = {\n${bytes}};\n")
  string(APPEND rows "    {\"${path}\", \"${type}\", text(kFile${index})},\n")
  math(EXPR index "${index} + 1")
endforeach()
file(WRITE ${OUTPUT}.new
     "// Made by clients/web/embed_files.cmake.
#include \"clients/web/web_files.h\"

namespace gnomon {
namespace {

${arrays}
template <std::size_t size>
std::string_view text(const unsigned char (&bytes)[size]) {
  return {reinterpret_cast<const char*>(bytes), size};
}

} // namespace

std::span<const WebFile> webFiles() {
  static const WebFile files[] = {
${rows}  };
  return files;
}

} // namespace gnomon
")
file(RENAME ${OUTPUT}.new ${OUTPUT})
