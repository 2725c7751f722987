# The commit this tree was built from, for `--version` and for the provenance of tables. Written at every
# build, and only when it changed, so that a commit does not recompile the tree.
set(ALBTPU_COMMIT "unknown" CACHE STRING "The commit, where the sources are there without git")
set(ALBTPU_GENERATED_DIR ${PROJECT_BINARY_DIR}/generated)
add_custom_target(albtpu_version_source
  COMMAND ${CMAKE_COMMAND}
          -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION} -DCOMMIT=${ALBTPU_COMMIT}
          -DTEMPLATE=${PROJECT_SOURCE_DIR}/cmake/version.cc.in
          -DOUTPUT=${ALBTPU_GENERATED_DIR}/version.cc
          -P ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake
  BYPRODUCTS ${ALBTPU_GENERATED_DIR}/version.cc
  COMMENT "Looking up the commit")
