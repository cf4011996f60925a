# Debian packages by CPack: lamina, lamina-cad, lamina-dev and python3-lamina. What lies in them is said in
# LaminaInstall.cmake; here is what Debian asks for beside it.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The lamina authors <authors@lamina.invalid>"
    CACHE STRING "Maintainer of the packages")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
# Each package has a summary of its own.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(CPACK_STRIP_FILES ON)
# Ours is the machine's file mode mask otherwise.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)

set(CPACK_COMPONENTS_ALL program cad development python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Libraries that the program is linked with are found by dpkg-shlibdeps. Those
# that it opens itself where it needs them are only recommended: OpenGL draws
# solids and the paper's samples, the fonts are those of OpenSCAD's text().
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME lamina)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "fonts-liberation, libosmesa6")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS
    "lamina-cad, lamina-dev, libegl1, openscad, openscad-mcad")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
"compiler from OpenSCAD designs to the layers of a 3D printer
lamina reads a design of OpenSCAD (.scad or .csg) and writes the layers that
wax and resin printers take: SLC, CLI, SVG, images for panels. It never builds
a mesh of the whole design: parts are cut layer by layer and joined there, so
that the contours are exact and the time is short.

It also checks, measures and draws layer files.")

# OpenCASCADE takes 80 MB, so its module is a package of its own.
set(CPACK_DEBIAN_CAD_PACKAGE_NAME lamina-cad)
set(CPACK_DEBIAN_CAD_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_CAD_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_CAD_PACKAGE_DEPENDS
    "lamina (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(CPACK_DEBIAN_CAD_DESCRIPTION
"compiler from OpenSCAD designs to layers - parts of CAD programs
lamina reads a design of OpenSCAD and makes the layers of a 3D printer.

This package lets it read parts of CAD programs, too: STEP, IGES and BREP, by
OpenCASCADE.")

# The archive needs at link time what the program is linked with.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME lamina-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
string(JOIN ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "lamina (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})"
  libdouble-conversion-dev libfmt-dev libminizip-dev libpng-dev
  libpugixml-dev libtbb-dev zlib1g-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake, g++")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
"compiler from OpenSCAD designs to layers - files for development
lamina reads a design of OpenSCAD and makes the layers of a 3D printer.

This package holds the library for C++ programs, its header, its CMake package
and an example.")

# Built for the Python of this Debian alone. Modules of the program make texts.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-lamina)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
math(EXPR next_python "${Python3_VERSION_MINOR} + 1")
string(JOIN ", " CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "lamina (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})"
  "python3 (>= 3.${Python3_VERSION_MINOR})" "python3 (<< 3.${next_python})"
  python3-numpy)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS
    "python3-matplotlib, python3-pandas, python3-shapely")
# They compile the package for Python, and remove what was compiled.
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/cmake/debian/python/postinst
    ${PROJECT_SOURCE_DIR}/cmake/debian/python/prerm)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION
"compiler from OpenSCAD designs to layers - Python 3 package
lamina reads a design of OpenSCAD and makes the layers of a 3D printer.

This package holds the module for Python 3: layers as arrays of numpy, weights,
prices, and what would go wrong in the print.")

# A reproducible build tells the date by SOURCE_DATE_EPOCH.
string(TIMESTAMP package_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(cmake/debian/changelog.in changelog.Debian @ONLY)
lamina_compress(${PROJECT_BINARY_DIR}/changelog.Debian changelog.Debian.gz)
# Nobody but Debian asks for these.
install(FILES ${PROJECT_BINARY_DIR}/changelog.Debian.gz
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/lamina
        COMPONENT program EXCLUDE_FROM_ALL)
foreach(package IN ITEMS lamina-cad:cad lamina-dev:development
                         python3-lamina:python)
  string(REPLACE ":" ";" package ${package})
  list(GET package 0 name)
  list(GET package 1 component)
  install(FILES ${PROJECT_BINARY_DIR}/changelog.Debian.gz
                ${PROJECT_BINARY_DIR}/changelog.gz cmake/debian/copyright
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name}
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

include(CPack)
