# SPDX-License-Identifier: GPL-3.0-or-later
# Every library of the project, found once, as Debian 12 packages it. scripts/setup.sh installs them.

set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE ON)
find_package(CGAL 5.5 REQUIRED)
find_package(TBB CONFIG REQUIRED)
find_package(embree 3.13 CONFIG REQUIRED)

find_package(EXPAT 2.5 REQUIRED)
find_package(assimp 5.2 CONFIG REQUIRED)
find_package(fmt CONFIG REQUIRED)
find_package(HDF5 1.10 REQUIRED COMPONENTS C)
find_package(PNG 1.6 REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(tomlplusplus CONFIG REQUIRED) # the target says TOML_HEADER_ONLY=0
find_package(VTK 9.1 REQUIRED COMPONENTS # never without components: it would ask for Qt
  CommonCore
  CommonDataModel
  CommonExecutionModel
  IOImage
  IOXML
  RenderingCore
  RenderingFreeType)
find_package(CLI11 CONFIG REQUIRED)
find_package(IfcPlusPlus REQUIRED)
find_package(Libnova MODULE REQUIRED)
find_package(OpenSubdiv MODULE REQUIRED)

if(CLERESTORY_TESTS)
  find_package(GTest CONFIG REQUIRED)
  # Debian's own interpreter, since python3-vtk9 belongs to it and not to a pyenv or conda in the PATH.
  find_program(CLERESTORY_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
  if(NOT CLERESTORY_PYTHON)
    find_program(CLERESTORY_PYTHON python3 REQUIRED)
  endif()
endif()
find_package(benchmark CONFIG)
