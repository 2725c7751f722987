# The commit that is built, for `--version` and for the provenance of tables. Looked up at every build and written only
# if it has changed, so that a commit recompiles one file.
set(ALBTPU_COMMIT "unknown" CACHE STRING "The commit, for sources without a git repository")
set(ALBTPU_GENERATED_DIR ${PROJECT_BINARY_DIR}/generated)
add_custom_target(albtpu_version_source
  COMMAND ${CMAKE_COMMAND}
          -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DVERSION=${ALBTPU_VERSION} -DCOMMIT=${ALBTPU_COMMIT}
          -DTEMPLATE=${PROJECT_SOURCE_DIR}/cmake/version.cc.in
          -DOUTPUT=${ALBTPU_GENERATED_DIR}/version.cc
          -P ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake
  BYPRODUCTS ${ALBTPU_GENERATED_DIR}/version.cc
  COMMENT "Looking up the commit")
