# Script: expands the includes of every shader and writes
#   ${OUTPUT}             one .cpp that holds the texts as string views, behind shader_sources.h;
#   ${EXPANDED}/<shader>  each text with its #version line, for glslangValidator.
#
#   cmake -DDIRECTORY=... -DSHADERS=surface.vert,view.frag -DINCLUDES=common_names.glsl,shared/light.h -DOUTPUT=... -DEXPANDED=... -P embed_shaders.cmake
#
# `#include "x"` takes x from DIRECTORY, and only if it is listed, so that the build knows what depends on what. A file
# is included once per shader: later includes of it give an empty line. `#include <x>` is C++'s: it gives an empty line,
# and so does `#pragma once`.

cmake_minimum_required(VERSION 3.25)

string(REPLACE "," ";" shaders "${SHADERS}")
string(REPLACE "," ";" includes "${INCLUDES}")

# Lines in `text`, into `result`.
function(count_lines text result)
  string(REGEX MATCHALL "\n" newlines "${text}")
  list(LENGTH newlines count)
  set(${result} ${count} PARENT_SCOPE)
endfunction()

# The expansion of one file, into `result`. `shader_files`, in the caller's scope, lists the files met so far; a file's
# place in it is its source number.
function(expand file result)
  file(READ "${DIRECTORY}/${file}" rest)
  string(REPLACE "\r\n" "\n" rest "${rest}")
  if(rest MATCHES "(^|\n)[ \t]*#[ \t]*version")
    message(FATAL_ERROR "${file}: #version is put before the text by gl::Program; remove it")
  endif()
  list(FIND shader_files "${file}" number)
  set(text "")
  set(rest "\n${rest}") # so that every line begins after a newline
  set(line 1)           # of what follows the first newline of `rest`
  while(rest MATCHES "\n[ \t]*(#[ \t]*include[^\n]*|#[ \t]*pragma[ \t]+once[^\n]*)")
    set(matched "${CMAKE_MATCH_0}")
    set(directive "${CMAKE_MATCH_1}")
    string(FIND "${rest}" "${matched}" head_length)
    string(SUBSTRING "${rest}" 0 ${head_length} head)
    string(LENGTH "${matched}" matched_length)
    math(EXPR tail_start "${head_length} + ${matched_length}")
    string(SUBSTRING "${rest}" ${tail_start} -1 rest)
    count_lines("${head}" head_lines)
    math(EXPR line "${line} + ${head_lines}") # of the directive
    math(EXPR next "${line} + 1")
    string(APPEND text "${head}\n")
    if(directive MATCHES "include[ \t]+\"([^\"]+)\"")
      set(included "${CMAKE_MATCH_1}")
      if(NOT included IN_LIST includes)
        message(FATAL_ERROR "${file}:${line}: \"${included}\" is not listed in GNOMON_SHADER_INCLUDES")
      endif()
      if(NOT included IN_LIST shader_files)
        list(LENGTH shader_files included_number)
        list(APPEND shader_files "${included}")
        expand("${included}" included_text)
        string(APPEND text "// source ${included_number}: ${included}\n#line 1 ${included_number}\n"
                           "${included_text}\n// source ${number}: ${file}\n#line ${next} ${number}")
      endif()
    elseif(NOT directive MATCHES "pragma|include[ \t]+<[^>]+>")
      message(FATAL_ERROR "${file}:${line}: can't read \"${directive}\"")
    endif()
    set(line ${next})
  endwhile()
  string(SUBSTRING "${text}${rest}" 1 -1 text)
  set(${result} "${text}" PARENT_SCOPE)
  set(shader_files "${shader_files}" PARENT_SCOPE)
endfunction()

# Clang counts a literal's length, and warns of more than 65,536 characters.
set(code "// Made by embed_shaders.cmake.\n#include <array>\n\n#include \"renderer/shaders/shader_sources.h\"\n\n"
         "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n\n")
list(JOIN code "" code)
list(LENGTH shaders shader_count)
string(APPEND code "namespace gnomon {\nnamespace {\n\nusing namespace std::string_view_literals;\n\nconstexpr std::array<ShaderSource, ${shader_count}> kSources{{\n")
foreach(shader IN LISTS shaders)
  set(shader_files "${shader}")
  expand("${shader}" text)
  set(text "// source 0: ${shader}\n#line 1 0\n${text}")
  string(APPEND code "{\"${shader}\", R\"gnomon(${text})gnomon\"sv},\n")
  file(WRITE "${EXPANDED}/${shader}" "#version 450 core\n${text}")
endforeach()
string(APPEND code "}};\n\n} // namespace\n\n"
                   "std::span<const ShaderSource> shaderSources() { return kSources; }\n\n"
                   "std::string_view shaderSource(std::string_view name) {\n"
                   "  for (const ShaderSource& source : kSources) {\n"
                   "    if (source.name == name) return source.text;\n  }\n  return {};\n}\n\n} // namespace gnomon\n")
file(WRITE "${OUTPUT}" "${code}")
