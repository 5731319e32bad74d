# What reads input is compiled by clang with the fuzzer's counters and with sanitizers. The solvers, which
# take minutes to compile and see no text, come as another build of the tree has made them.
set(WHIRL_FUZZ_SOLVERS ${PROJECT_SOURCE_DIR}/build/release CACHE PATH
    "Build directory with the libraries of libbase, libfe, libdyn and libdata")
target_compile_options(whirl_options INTERFACE
  -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize=vptr -fno-sanitize-recover=undefined)
target_link_options(whirl_options INTERFACE -fsanitize=address,undefined -fno-sanitize=vptr)

find_package(SUNDIALS 6.4 REQUIRED)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(highway REQUIRED IMPORTED_TARGET GLOBAL libhwy)
add_library(whirl_solvers INTERFACE)
target_link_libraries(whirl_solvers INTERFACE
  ${WHIRL_FUZZ_SOLVERS}/libdata/libwhirl_data.a ${WHIRL_FUZZ_SOLVERS}/libdyn/libwhirl_dyn.a
  ${WHIRL_FUZZ_SOLVERS}/libfe/libwhirl_fe.a
  ${WHIRL_FUZZ_SOLVERS}/libbase/libwhirl_base.a
  SUNDIALS::cvode SUNDIALS::arkode SUNDIALS::nvecserial SUNDIALS::sunmatrixdense
  SUNDIALS::sunlinsoldense SUNDIALS::sunnonlinsolfixedpoint PkgConfig::highway quadmath
  Threads::Threads KLU::klu)

# Meshing, errors and readings of records, which see what was read, are compiled for the fuzzer too. The solvers' library may hold
# them in one object with others (a unity build), so that it cannot leave them out: the first ones count.
target_link_options(whirl_solvers INTERFACE LINKER:--allow-multiple-definition)
add_library(whirl_fe STATIC libbase/error.cpp libfe/mesh/mesh.cpp libfe/assembly/assemble.cpp libfe/assembly/properties.cpp
            libdata/measured/measured_record.cpp libdata/measured/key_phasor.cpp
            libdata/measured/probe_readings.cpp)
target_link_libraries(whirl_fe PUBLIC whirl_options Eigen3::Eigen fmt::fmt whirl_solvers)
add_library(whirl_data INTERFACE)
target_link_libraries(whirl_data INTERFACE whirl_fe)
add_subdirectory(libio)
add_subdirectory(libverbs)
add_subdirectory(tests/fuzz)
