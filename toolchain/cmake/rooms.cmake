# One static library a room, one program a main: all the product's targets are made here.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# Counting bits is half of the search: one instruction since x86-64-v2, four lanes of arithmetic since v3 (2013).
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" AND NOT CMAKE_CROSSCOMPILING)
  set(IVO_CPU x86-64-v3 CACHE STRING "Processor that the product is built for, as -march names it")
else()
  set(IVO_CPU "" CACHE STRING "Processor that the product is built for, as -march names it")
endif()

add_library(ivo_flags INTERFACE)
if(IVO_CPU)
  target_compile_options(ivo_flags INTERFACE -march=${IVO_CPU})
endif()
target_include_directories(ivo_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(
  ivo_flags
  INTERFACE -Wall
            -Wextra
            -Wpedantic
            -Wconversion
            -Wshadow
            -Wnon-virtual-dtor
            -Wold-style-cast
            -Werror
            # The same sums on every CPU: no fused multiply-add behind the formula's back.
            -ffp-contract=off)

option(IVO_FOLDER_AT_ONCE "Compile the sources of a folder as one: sooner done, where a build is made once" OFF)

# ivo_folder_at_once(TARGET SOURCE...): each folder of them becomes one source. A name of an anonymous namespace must therefore be given
# only once in a folder.
function(ivo_folder_at_once target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # What is private to a source is private to its folder.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  foreach(source ${ARGN})
    cmake_path(GET source PARENT_PATH group)
    cmake_path(RELATIVE_PATH group BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(REPLACE "/" "_" group ${group})
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# ivo_room(FOLDER [EXCEPT file...] [LINKS target...]): the library of FOLDER's sources. firmware/motion becomes
# ivo_firmware_motion.
function(ivo_room folder)
  cmake_parse_arguments(ROOM "" "" "EXCEPT;LINKS" ${ARGN})
  string(REPLACE "/" "_" name ivo_${folder})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  list(TRANSFORM ROOM_EXCEPT PREPEND ${PROJECT_SOURCE_DIR}/)
  list(REMOVE_ITEM sources ${ROOM_EXCEPT})
  if(sources)
    add_library(${name} STATIC ${sources})
    target_link_libraries(${name} PUBLIC ivo_flags ${ROOM_LINKS})
    if(IVO_FOLDER_AT_ONCE)
      ivo_folder_at_once(${name} ${sources})
    endif()
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ivo_flags ${ROOM_LINKS})
  endif()
endfunction()

# ivo_program(NAME MAIN [LINKS target...])
function(ivo_program name main)
  cmake_parse_arguments(PROGRAM "" "" "LINKS" ${ARGN})
  if(EXISTS ${PROJECT_SOURCE_DIR}/${main})
    add_executable(${name} ${PROJECT_SOURCE_DIR}/${main})
    target_link_libraries(${name} PRIVATE ${PROGRAM_LINKS})
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  endif()
endfunction()

# ivo_compiled_in_eds(TARGET NAME...): the text of config/eds/NAME.eds becomes a function NAME_eds_text of TARGET.
function(ivo_compiled_in_eds target)
  foreach(IVO_EDS_NAME ${ARGN})
    set(file ${PROJECT_SOURCE_DIR}/config/eds/${IVO_EDS_NAME}.eds)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} IVO_EDS_TEXT)
    configure_file(${PROJECT_SOURCE_DIR}/drivers/eds/shipped_eds_text.cpp.in
                   ${PROJECT_BINARY_DIR}/generated/${IVO_EDS_NAME}_eds_text.cpp @ONLY)
    target_sources(${target} PRIVATE ${PROJECT_BINARY_DIR}/generated/${IVO_EDS_NAME}_eds_text.cpp)
  endforeach()
endfunction()
