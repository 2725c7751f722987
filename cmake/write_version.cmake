# The commit by git; in an archive made by `git archive`, by the file in which it has put it.
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE_DIR}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} describe --always --dirty --abbrev=12
                  OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE
                  RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(COMMIT ${described})
  endif()
elseif(COMMIT STREQUAL "unknown" AND EXISTS ${SOURCE_DIR}/cmake/commit.txt)
  file(READ ${SOURCE_DIR}/cmake/commit.txt archived)
  if(archived MATCHES "^[0-9a-f]+")
    string(SUBSTRING ${CMAKE_MATCH_0} 0 12 COMMIT)
  endif()
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
