# What the Python package is built with. Where WHIRL_PYTHON is AUTO and something is missing, it is OFF
# from here on. The libraries that a module is made of are position-independent code; with hidden names
# that is as fast as a program's.

# Packages of tools/setup are those of Debian's Python, wherever another one comes first in the PATH.
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the package is for")
endif()
set(parts Interpreter Development.Module)
if(WHIRL_PYTHON STREQUAL "AUTO")
  find_package(Python3 3.11 QUIET COMPONENTS ${parts})
  find_package(pybind11 2.10 CONFIG QUIET)
  if(NOT (Python3_Development.Module_FOUND AND pybind11_FOUND))
    message(STATUS "No Python package: it needs python3-dev and pybind11-dev (tools/setup --python)")
    set(WHIRL_PYTHON OFF)
  endif()
else()
  find_package(Python3 3.11 REQUIRED COMPONENTS ${parts})
  find_package(pybind11 2.10 CONFIG REQUIRED)
endif()

if(WHIRL_PYTHON)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  set(CMAKE_CXX_VISIBILITY_PRESET hidden)
  set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
endif()
