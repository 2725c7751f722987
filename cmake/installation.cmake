# Installs data and documents beside the programs and the protos. Each program finds the tables relative to itself.
set(data ${CMAKE_INSTALL_DATADIR}/albtpu)
file(GLOB shipped_tables CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tables/shipped/*.h5)
install(FILES ${shipped_tables} DESTINATION ${data}/tables)
install(FILES ${PROJECT_SOURCE_DIR}/tables/water/shipped/water_column.h5 DESTINATION ${data}/water)
file(GLOB shipped_sensors CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/config/sensors/shipped/*.toml)
install(FILES ${shipped_sensors} DESTINATION ${data}/sensors)
file(GLOB specifications CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/quality/report/specifications/*.toml)
install(FILES ${specifications} DESTINATION ${data}/specifications)
# The Python modules that draw the page of a report, for albtpu-query.
install(DIRECTORY clients/python/src/albtpu DESTINATION ${data}/python PATTERN "__pycache__" EXCLUDE)
install(FILES CHANGELOG.md CONTRIBUTING.md LICENSE README.md SECURITY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES tables/FORMAT.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/tables)
install(DIRECTORY clients/cpp DESTINATION ${CMAKE_INSTALL_DOCDIR}/clients)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
# The sources of the Python package, for pip or PYTHONPATH.
install(DIRECTORY clients/python DESTINATION ${CMAKE_INSTALL_DOCDIR}/clients PATTERN "__pycache__" EXCLUDE
        PATTERN "*.egg-info" EXCLUDE PATTERN "build" EXCLUDE PATTERN ".mypy_cache" EXCLUDE)
install(DIRECTORY validation/paper validation/plots DESTINATION ${data}/validation
        PATTERN "__pycache__" EXCLUDE)

# The libraries for users' C++ programs.
albtpu_package_component(tables)
albtpu_package_component(client)
