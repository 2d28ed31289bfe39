# SPDX-License-Identifier: GPL-2.0-or-later
# (cd build && cpack): a Debian package for the version of the package yade that is installed here. In another one objects may
# lie in memory otherwise.
execute_process(COMMAND dpkg-query -W -f "\${Version}" yade OUTPUT_VARIABLE yade_version ERROR_QUIET)
if(YADE_SOURCE_DIR OR NOT yade_version)
    return()
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME python3-softgrain)
set(CPACK_PACKAGE_CONTACT "the authors of softgrain <softgrain@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Soft grains for YADE")
set(CPACK_PACKAGE_DESCRIPTION "Grains that change shape when they are squeezed: Material Point Method inside the grains, Contact
Dynamics between them. A plugin for the discrete element code YADE.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "yade (= ${yade_version}), python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-matplotlib")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-h5py, python3-siconos, python3-vtk9")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/postinst;${CMAKE_CURRENT_LIST_DIR}/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
