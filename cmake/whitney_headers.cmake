# The headers of a module that users may include, as the file set HEADERS of its target: all .h files below the current
# folder but those that cmake/internal_headers.txt lists and those in the folders named. What is left out is neither
# installed nor included by what is installed; tests/install and tests/architecture check that.
function(whitney_public_headers target)
  set(list ${PROJECT_SOURCE_DIR}/cmake/internal_headers.txt)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS *.h)
  file(STRINGS ${list} lines REGEX "^[^#]")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE " \\| .*" "" header "${line}")
    list(REMOVE_ITEM headers ${PROJECT_SOURCE_DIR}/${header})
  endforeach()
  foreach(folder IN LISTS ARGN)
    list(FILTER headers EXCLUDE REGEX "^${CMAKE_CURRENT_SOURCE_DIR}/${folder}/")
  endforeach()
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
endfunction()
