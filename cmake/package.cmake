# The installed CMake package, for C++ programs of others: find_package(albtpu) gives albtpu::tables and
# albtpu::client (albtpuConfig.cmake.in says when).
include(CMakePackageConfigHelpers)
set(ALBTPU_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/albtpu)
configure_package_config_file(cmake/albtpuConfig.cmake.in ${PROJECT_BINARY_DIR}/package/albtpuConfig.cmake
  INSTALL_DESTINATION ${ALBTPU_PACKAGE_DIR})
# Before version 1 a minor version may change what programs see.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/albtpuConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/albtpuConfig.cmake
              ${PROJECT_BINARY_DIR}/package/albtpuConfigVersion.cmake
        DESTINATION ${ALBTPU_PACKAGE_DIR})

# Makes a static library part of a component of the package, with the headers that its users include:
#   albtpu_package(TARGET COMPONENT [NAME name] [HEADERS ...])
# It is albtpu::NAME there, albtpu::COMPONENT unless named, and may be linked into shared objects.
#
# Installed headers are <albtpu/tables/table_io.h>, in the tree "tables/file/table_io.h": a folder `tables` on the
# include path of another project would hide headers of its own, or be hidden by them, and users need not follow
# the rooms of the tree. What the headers include is respelled as they are installed.
function(albtpu_package target component)
  cmake_parse_arguments(ARG "" "NAME" "HEADERS" ${ARGN})
  if(NOT ARG_NAME)
    set(ARG_NAME ${component})
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${ARG_NAME} POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  install(TARGETS ${target} EXPORT albtpu_${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})

  file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(folder ${CMAKE_INSTALL_INCLUDEDIR}/albtpu/${room})
  install(FILES ${ARG_HEADERS} DESTINATION ${folder})
  list(TRANSFORM ARG_HEADERS REPLACE ".*/" "")
  install(CODE "set(folder \"${folder}\")\nset(headers \"${ARG_HEADERS}\")")
  install(SCRIPT ${PROJECT_SOURCE_DIR}/cmake/respell_includes.cmake)
endfunction()

# Writes down the libraries of a component; to be called once for each, last.
function(albtpu_package_component component)
  install(EXPORT albtpu_${component} FILE albtpu_${component}.cmake NAMESPACE albtpu::
          DESTINATION ${ALBTPU_PACKAGE_DIR})
endfunction()
