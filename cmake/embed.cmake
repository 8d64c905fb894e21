# stdc_embed(TARGET FUNCTION FILE [NAMESPACE stdc]): makes the file part of the target. Declare the function where it is used, as
#   namespace stdc::app { std::string_view FUNCTION(); }
# (or in the namespace that is given). It gives the file's bytes. The assembler takes them in, which costs no compile time, whatever the size; the checksum
# in the source tells ccache that the file has changed.
function(stdc_embed target function file)
  cmake_parse_arguments(EMBED "" "NAMESPACE" "" ${ARGN})
  if(NOT EMBED_NAMESPACE)
    set(EMBED_NAMESPACE stdc::app)
  endif()
  get_filename_component(path ${file} ABSOLUTE)
  file(SHA256 ${path} checksum)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded_${function}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [[
// Made from @file@ (@checksum@) by CMake.
#include <cstddef>
#include <string_view>

__asm__(
    ".pushsection .rodata\n.balign 16\n"
    ".globl stdc_@function@_begin\nstdc_@function@_begin:\n"
    ".incbin \"@path@\"\n"
    ".globl stdc_@function@_end\nstdc_@function@_end:\n"
    ".byte 0\n.popsection\n");

extern "C" {
extern const char stdc_@function@_begin[];
extern const char stdc_@function@_end[];
}

namespace @EMBED_NAMESPACE@ {

std::string_view @function@();

std::string_view @function@() {
  return {stdc_@function@_begin, static_cast<std::size_t>(stdc_@function@_end - stdc_@function@_begin)};
}

}  // namespace @EMBED_NAMESPACE@
]])
  target_sources(${target} PRIVATE ${source})
  set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON OBJECT_DEPENDS ${path})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
endfunction()
