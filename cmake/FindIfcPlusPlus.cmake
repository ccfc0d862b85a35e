# SPDX-License-Identifier: GPL-3.0-or-later
# IfcPlusPlus and the carve that it was built with, which Debian packages without any file for CMake.
# Never define ENABLE_OPENMP with it: that changes the layout of a class against the packaged library.
#
#   IfcPlusPlus::IfcPlusPlus

find_path(IfcPlusPlus_INCLUDE_DIR ifcpp/model/BuildingModel.h)
find_library(IfcPlusPlus_LIBRARY IfcPlusPlus PATH_SUFFIXES ifcplusplus)
find_library(IfcPlusPlus_carve_LIBRARY carve PATH_SUFFIXES ifcplusplus)
mark_as_advanced(IfcPlusPlus_INCLUDE_DIR IfcPlusPlus_LIBRARY IfcPlusPlus_carve_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(IfcPlusPlus
  REQUIRED_VARS IfcPlusPlus_LIBRARY IfcPlusPlus_carve_LIBRARY IfcPlusPlus_INCLUDE_DIR)

if(IfcPlusPlus_FOUND AND NOT TARGET IfcPlusPlus::IfcPlusPlus)
  add_library(IfcPlusPlus::IfcPlusPlus UNKNOWN IMPORTED)
  set_target_properties(IfcPlusPlus::IfcPlusPlus PROPERTIES
    IMPORTED_LOCATION ${IfcPlusPlus_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${IfcPlusPlus_INCLUDE_DIR};${IfcPlusPlus_INCLUDE_DIR}/ifcpp/IFC4/include"
    INTERFACE_LINK_LIBRARIES ${IfcPlusPlus_carve_LIBRARY})
endif()
