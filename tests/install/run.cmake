# Builds and runs a stranger's programs (main.cc, every C++ snippet of README.md, every examples/*.cc) and checks what
# they write. FROM says how the stranger comes to the library:
#   package                     what is installed from BUILD_DIR, with the stranger's own flags, one set after the other
#   subdirectory, fetch_content the source, built once more
# SOURCE_DIR BUILD_DIR WORK_DIR GENERATOR CXX CONFIG; SANITIZE: the sanitizers of the build.
foreach(variable SOURCE_DIR BUILD_DIR WORK_DIR GENERATOR CXX CONFIG FROM)
  if("${${variable}}" STREQUAL "")
    message(FATAL_ERROR "${variable} is not set")
  endif()
endforeach()

function(run where)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output
                  WORKING_DIRECTORY ${where})
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nfailed with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR}/source)

# Copies, so that no header can be found beside the programs by accident.
file(GLOB examples ${SOURCE_DIR}/examples/*.cc)
file(COPY ${SOURCE_DIR}/tests/install/CMakeLists.txt ${SOURCE_DIR}/tests/install/main.cc ${examples}
     DESTINATION ${WORK_DIR}/source)
run(${WORK_DIR} awk -v DIR=${WORK_DIR}/source -f ${SOURCE_DIR}/tests/install/snippets.awk ${SOURCE_DIR}/README.md)
file(GLOB programs RELATIVE ${WORK_DIR}/source ${WORK_DIR}/source/*.cc)
list(REMOVE_ITEM programs main.cc)
list(FILTER programs INCLUDE REGEX "^readme_")
if(NOT programs)
  message(FATAL_ERROR "README.md has no C++ snippet")
endif()
foreach(example IN LISTS examples)
  get_filename_component(name ${example} NAME)
  list(APPEND programs ${name})
endforeach()

# What the programs write, with its Euler characteristic. A program that is new has to be entered here.
set(meshes_readme_1 sphere.ply=2)
set(meshes_readme_2 klein.noff=0)
set(meshes_circle_in_ten_lines circle.noff=0)
set(meshes_own_oracle ring.ply=0)

function(check_consumer name cxx flags)
  set(build ${WORK_DIR}/${name})
  run(${WORK_DIR} ${CMAKE_COMMAND} -S ${WORK_DIR}/source -B ${build} -G ${GENERATOR} -DCMAKE_BUILD_TYPE=
      -DCMAKE_CXX_COMPILER=${cxx} "-DCMAKE_CXX_FLAGS=${flags}" -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix
      -DWHITNEY_FROM=${FROM} -DWHITNEY_SOURCE_DIR=${SOURCE_DIR})
  run(${WORK_DIR} ${CMAKE_COMMAND} --build ${build})
  foreach(program IN LISTS programs)
    get_filename_component(program ${program} NAME_WE)
    if(NOT meshes_${program})
      message(FATAL_ERROR "${program}: tests/install/run.cmake does not know what it writes")
    endif()
    run(${build} ${build}/${program})
    list(APPEND meshes ${meshes_${program}})
  endforeach()
  run(${build} ${build}/main ${meshes})
  message(STATUS "${name}: ${output}")
endfunction()

if(FROM STREQUAL "package")
  run(${WORK_DIR} ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix --config ${CONFIG}
      --component development)
  if(EXISTS ${WORK_DIR}/prefix/include/whitney-toolkit/coxeter/base/eigen_view.h)
    message(FATAL_ERROR "an internal header was installed")
  endif()
endif()
if(SANITIZE)
  check_consumer(sanitized ${CXX} "-fsanitize=${SANITIZE}")
elseif(FROM STREQUAL "package")
  check_consumer(no_flags ${CXX} "")
  check_consumer(O0 ${CXX} "-O0")
  check_consumer(native ${CXX} "-O2 -march=native")
  find_program(CLANG NAMES clang++)
  if(CLANG)
    check_consumer(clang ${CLANG} "-O1")
  else()
    message(STATUS "clang++ is not here: its turn is left out")
  endif()
else()
  check_consumer(${FROM} ${CXX} "")
endif()
