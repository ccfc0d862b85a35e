# SPDX-License-Identifier: GPL-3.0-or-later
# OpenSubdiv's CPU library. Debian's own package file names a static library that is not shipped.
#
#   OpenSubdiv::osdCPU

find_path(OpenSubdiv_INCLUDE_DIR opensubdiv/bfr/refinerSurfaceFactory.h)
find_library(OpenSubdiv_LIBRARY osdCPU)
mark_as_advanced(OpenSubdiv_INCLUDE_DIR OpenSubdiv_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenSubdiv REQUIRED_VARS OpenSubdiv_LIBRARY OpenSubdiv_INCLUDE_DIR)

if(OpenSubdiv_FOUND AND NOT TARGET OpenSubdiv::osdCPU)
  add_library(OpenSubdiv::osdCPU UNKNOWN IMPORTED)
  set_target_properties(OpenSubdiv::osdCPU PROPERTIES
    IMPORTED_LOCATION ${OpenSubdiv_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${OpenSubdiv_INCLUDE_DIR})
endif()
