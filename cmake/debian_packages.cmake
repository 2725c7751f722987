# The Debian packages, made by CPack for the Debian on which it runs. package.sh configures for them: below /usr, with
# ALBTPU_DEBIAN_PACKAGES. What is installed for everybody is in the component of its package (`COMPONENT`); here is what
# only Debian has: copyright, changelog, service, completion of installed Python modules.
set(ALBTPU_DEBIAN_PACKAGES "" CACHE STRING "The date of their changelog, to configure for Debian packages (package.sh)")
if(NOT ALBTPU_DEBIAN_PACKAGES)
  return()
endif()
set(packaging ${PROJECT_SOURCE_DIR}/packaging)
set(made ${PROJECT_BINARY_DIR}/packaging)
file(STRINGS /etc/os-release debian REGEX "^VERSION_ID=")
string(REGEX REPLACE "[^0-9]" "" debian "${debian}")

# 1.0.0~rc1 is older than 1.0.0, and 1.0.0+deb12u0 than 1.0.0+deb13u0: an upgrade of Debian upgrades packages, too.
string(REPLACE "-" "~" version ${ALBTPU_VERSION})
set(CPACK_DEBIAN_PACKAGE_VERSION ${version}+deb${debian}u0)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME albtpu)
set(CPACK_PACKAGE_CONTACT "albtpu maintainers <maintainers@albtpu.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_SET_DESTDIR ON)  # For /etc.
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL programs generator development python)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# The libraries of packages.txt; of some only headers are compiled in, which no dependency of a package tells.
file(READ packages.txt libraries)
string(REGEX MATCH "\n# libraries,[^\n]*\n([^#]*)\n#" libraries "${libraries}")
string(REPLACE "\n" ";" libraries "${CMAKE_MATCH_1}")

# What all packages have: name, section, copyright and changelog; all but that of Python have the licences of libraries.
#   albtpu_debian_package(COMPONENT package section [comment for its copyright file])
function(albtpu_debian_package component package section)
  set(COMMENT "")
  if(ARGN)
    set(COMMENT "Comment: ${ARGN}\n")
  endif()
  set(LIBRARIES "")
  if(NOT component STREQUAL "python")
    set(LIBRARIES "Comment: The licences of libraries of which it contains code are in libraries.\n")
    foreach(library IN LISTS libraries)
      file(REAL_PATH /usr/share/doc/${library}/copyright licence)
      install(FILES ${licence} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}/libraries RENAME ${library}.txt
              COMPONENT ${component})
    endforeach()
  endif()
  configure_file(${packaging}/copyright.in ${made}/${package}/copyright @ONLY)
  file(CONFIGURE OUTPUT ${made}/${package}/changelog CONTENT
"${package} (${CPACK_DEBIAN_PACKAGE_VERSION}) stable; urgency=medium

  * Version ${version}, built from commit ${ALBTPU_COMMIT}.

 -- ${CPACK_PACKAGE_CONTACT}  ${ALBTPU_DEBIAN_PACKAGES}
")
  execute_process(COMMAND gzip -9nf ${made}/${package}/changelog COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${made}/${package}/copyright ${made}/${package}/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
  string(TOUPPER ${component} name)
  set(CPACK_DEBIAN_${name}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  if(EXISTS ${packaging}/${package}.lintian)
    install(FILES ${packaging}/${package}.lintian DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
            RENAME ${package} COMPONENT ${component})
  endif()
endfunction()

albtpu_debian_package(programs albtpu science)
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "uncertainty of airborne lidar bathymetry
 albtpu-query computes the total horizontal and vertical uncertainty of
 every point of an airborne lidar bathymetry survey, and compares it with the
 orders of IHO S-44. albtpu-serve answers such queries over gRPC.")
# What draws the page of a report is suggested only: recommended, it would bring a compiler by what it recommends.
# GDAL is loaded when it is needed, which no dependency tells: "libgdal32".
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "proj-data")
if(ALBTPU_WITH_GDAL)
  execute_process(COMMAND dpkg-query --search "*/${ALBTPU_GDAL_LIBRARY}" OUTPUT_VARIABLE gdal_package
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[^:]+" gdal_package "${gdal_package}")
  string(APPEND CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS ", ${gdal_package}")
endif()
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "albtpu-generate, bash-completion, python3-matplotlib, python3-netcdf4")
file(CONFIGURE OUTPUT ${made}/conffiles CONTENT "/etc/default/albtpu-serve\n")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_CONTROL_EXTRA
  "${made}/conffiles;${packaging}/albtpu/postinst;${packaging}/albtpu/prerm;${packaging}/albtpu/postrm")
install(FILES ${packaging}/albtpu/albtpu-serve.service DESTINATION /usr/lib/systemd/system COMPONENT programs)
install(FILES ${packaging}/albtpu/albtpu-serve.default DESTINATION /etc/default RENAME albtpu-serve
        COMPONENT programs)
# The server serves one folder: the shipped tables by links, and those that are put beside them.
file(REMOVE_RECURSE ${made}/tables)
file(MAKE_DIRECTORY ${made}/tables)
foreach(table IN LISTS shipped_tables)
  cmake_path(GET table FILENAME file)
  file(CREATE_LINK ${CMAKE_INSTALL_FULL_DATADIR}/albtpu/tables/${file} ${made}/tables/${file} SYMBOLIC)
endforeach()
install(DIRECTORY ${made}/tables DESTINATION /var/lib/albtpu COMPONENT programs)

albtpu_debian_package(generator albtpu-generate science
"albtpu-generate is linked with FFTW, which is under the GNU General Public
 License, version 2 or later. This binary is therefore distributed under version
 3 of that license, /usr/share/common-licenses/GPL-3.")
set(CPACK_COMPONENT_GENERATOR_DESCRIPTION "tables of the uncertainty that a sea adds to lidar
 albtpu-generate computes by Monte Carlo the tables from which albtpu-query
 and albtpu-serve interpolate the uncertainty of lidar pulses.")
set(CPACK_DEBIAN_GENERATOR_PACKAGE_RECOMMENDS "albtpu")
set(CPACK_DEBIAN_GENERATOR_PACKAGE_SUGGESTS "openmpi-bin, python3-matplotlib")

albtpu_debian_package(development libalbtpu-dev libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "uncertainty of airborne lidar bathymetry - C++ library
 Headers, static libraries, CMake configuration and protos: reading tables,
 interpolating in them in process, and querying a server.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libabsl-dev, libgrpc++-dev, libhdf5-dev, libhwy-dev, libprotobuf-dev, \
libssl-dev, libtbb-dev, protobuf-compiler, protobuf-compiler-grpc, zlib1g-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "albtpu, cmake, g++")

albtpu_debian_package(python python3-albtpu python)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "uncertainty of airborne lidar bathymetry - Python package
 Queries a server or a table file for arrays of lidar pulses, with NumPy.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3:any, python3-grpcio, python3-h5py, python3-numpy, python3-protobuf")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-netcdf4, python3-tqdm, python3-xarray")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${packaging}/python3-albtpu/postinst;${packaging}/python3-albtpu/prerm")
set(modules lib/python3/dist-packages)
install(DIRECTORY clients/python/src/albtpu DESTINATION ${modules} COMPONENT python PATTERN "__pycache__" EXCLUDE)
# Its version, and that xarray opens tables by it.
file(COPY clients/python/pyproject.toml clients/python/README.md clients/python/src DESTINATION ${made}/python)
execute_process(COMMAND /usr/bin/python3 -BW ignore -c "import setuptools; setuptools.setup()" -q egg_info
                WORKING_DIRECTORY ${made}/python COMMAND_ERROR_IS_FATAL ANY)
install(DIRECTORY ${made}/python/src/albtpu.egg-info DESTINATION ${modules} COMPONENT python
        PATTERN "SOURCES.txt" EXCLUDE)

include(CPack)
