# Installs the build into a prefix of its own, and builds and runs a project against it.
#   cmake -DBUILD=... -DSOURCE=... -P run.cmake
set(prefix ${BUILD}/consumer/prefix)
file(REMOVE_RECURSE ${prefix})
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BUILD}/consumer/build -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${BUILD}/consumer/build)
run(${BUILD}/consumer/build/consumer)
run(${BUILD}/consumer/build/reader ${prefix}/share/whirl/models/two_disk_mac.toml)
run(${prefix}/bin/whirl --version)
