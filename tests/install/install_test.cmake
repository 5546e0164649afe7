# Run by CTest; see CMakeLists.txt.
cmake_minimum_required(VERSION 3.25)
set(prefix ${FOLDER}/prefix)
set(project_build ${FOLDER}/build)
file(REMOVE_RECURSE ${prefix} ${project_build})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${output}")
  endif()
endfunction()

set(sanitize "")
if(SANITIZE)
  set(sanitize "-fsanitize=${SANITIZE}")
endif()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -G Ninja -S ${PROJECT} -B ${project_build} -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_FLAGS=${sanitize})
run(${CMAKE_COMMAND} --build ${project_build})

# Every installed header by itself, in whatever order.
file(GLOB_RECURSE headers RELATIVE ${prefix}/include/keyline ${prefix}/include/keyline/*.h)
list(LENGTH headers count)
if(count LESS 30)
  message(FATAL_ERROR "only ${count} headers were installed")
endif()
list(REVERSE headers)
list(TRANSFORM headers PREPEND "#include \"")
list(TRANSFORM headers APPEND "\"\n")
string(JOIN "" includes ${headers})
file(WRITE ${FOLDER}/headers.cpp "${includes}")
run(${CXX} -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I ${prefix}/include/keyline ${FOLDER}/headers.cpp)

# The project's own node, between nodes of Keyline's.
run(${project_build}/posterise ${project_build}/graph.json ${PLATE} ${FOLDER}/steps.exr)

# The installed program, with its helper programs, from any folder.
file(WRITE ${FOLDER}/graph.json "{\"keyline\": 1, \"nodes\": {
  \"in\": {\"type\": \"read\", \"file\": \"${FOLDER}/steps.exr\"},
  \"out\": {\"type\": \"write\", \"in\": \"in\", \"file\": \"steps.png\"}}}")
run(${prefix}/bin/keyline render ${FOLDER}/graph.json --progress none)
run(${prefix}/bin/keyline nodes canny)
run(${prefix}/bin/keyline info ${FOLDER}/steps.png)
