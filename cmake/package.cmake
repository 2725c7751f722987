# The installed CMake package for users' C++ programs: find_package(albtpu) defines albtpu::tables and albtpu::client;
# see albtpuConfig.cmake.in.
include(CMakePackageConfigHelpers)
set(ALBTPU_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/albtpu)
configure_package_config_file(cmake/albtpuConfig.cmake.in ${PROJECT_BINARY_DIR}/package/albtpuConfig.cmake
  INSTALL_DESTINATION ${ALBTPU_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/albtpuConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/albtpuConfig.cmake
              ${PROJECT_BINARY_DIR}/package/albtpuConfigVersion.cmake
        DESTINATION ${ALBTPU_PACKAGE_DIR} COMPONENT development)

# Adds a static library and its public headers to a component of the package:
#   albtpu_package(TARGET COMPONENT [NAME name] [HEADERS ...])
# Users link it as albtpu::NAME (by default albtpu::COMPONENT). It may be linked into shared objects.
#
# The header "tables/file/table_io.h" of the source tree is installed as <albtpu/tables/table_io.h>: a folder `tables`
# on the include path of another project would hide headers of that project, or be hidden by them, and users do not
# depend on the rooms of the source tree. The #include lines of the headers are changed accordingly when they are
# installed.
function(albtpu_package target component)
  cmake_parse_arguments(ARG "" "NAME" "HEADERS" ${ARGN})
  if(NOT ARG_NAME)
    set(ARG_NAME ${component})
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${ARG_NAME})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  install(TARGETS ${target} EXPORT albtpu_${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          COMPONENT development)

  file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(folder ${CMAKE_INSTALL_INCLUDEDIR}/albtpu/${room})
  install(FILES ${ARG_HEADERS} DESTINATION ${folder} COMPONENT development)
  list(TRANSFORM ARG_HEADERS REPLACE ".*/" "")
  install(CODE "set(folder \"${folder}\")\nset(headers \"${ARG_HEADERS}\")" COMPONENT development)
  install(SCRIPT ${PROJECT_SOURCE_DIR}/cmake/respell_includes.cmake COMPONENT development)
endfunction()

# Exports the libraries of a component; to be called once per component, after all of its albtpu_package().
function(albtpu_package_component component)
  install(EXPORT albtpu_${component} FILE albtpu_${component}.cmake NAMESPACE albtpu::
          DESTINATION ${ALBTPU_PACKAGE_DIR} COMPONENT development)
endfunction()
