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
  file(READ ${SOURCE_DIR}/cmake/commit.txt archived LIMIT 12)
  if(archived MATCHES "^[0-9a-f]+$")
    set(COMMIT ${archived})
  endif()
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
