# The headers of a module that users may include, as the file set HEADERS of its target: all .h files below the current
# folder but those whose path below it matches one of the expressions. What is left out is neither installed nor included
# by what is installed; tests/install checks that.
function(whitney_public_headers target)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS *.h)
  foreach(internal IN LISTS ARGN)
    list(FILTER headers EXCLUDE REGEX "^${CMAKE_CURRENT_SOURCE_DIR}/${internal}")
  endforeach()
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
endfunction()
