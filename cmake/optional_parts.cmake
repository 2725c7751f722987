# Parts of the build that need packages which may be missing. test.sh prints which of them were not built.

# Decides whether to build such a part:
#   albtpu_optional_part(OPTION FOUND variable RESULT variable PART text NEEDS text PACKAGE name)
# The user sets OPTION to AUTO (build the part if FOUND is true; the default), ON (fail if it is not) or OFF. RESULT is
# set in the calling scope. The cache holds only what the user asked for, not what was found, so that a package that is
# installed after the first configuration counts at the next.
function(albtpu_optional_part option)
  cmake_parse_arguments(ARG "" "FOUND;RESULT;PART;NEEDS;PACKAGE" "" ${ARGN})
  set(${option} AUTO CACHE STRING "Build ${ARG_PART}: AUTO (if ${ARG_NEEDS} is found), ON or OFF")
  set_property(CACHE ${option} PROPERTY STRINGS AUTO ON OFF)
  string(TOUPPER "${${option}}" wanted)
  set(${ARG_RESULT} FALSE PARENT_SCOPE)
  if(wanted STREQUAL "AUTO" AND NOT ${ARG_FOUND})
    albtpu_not_built(${ARG_PART} ${ARG_NEEDS} ${ARG_PACKAGE})
  elseif(wanted STREQUAL "AUTO")
    set(${ARG_RESULT} TRUE PARENT_SCOPE)
  elseif(NOT ${option})
    set_property(GLOBAL APPEND PROPERTY ALBTPU_NOT_BUILT "${ARG_PART} (${option} is OFF)\; -D${option}=AUTO")
  elseif(NOT ${ARG_FOUND})
    message(FATAL_ERROR "${option} is ON, but ${ARG_NEEDS} is missing; "
      "apt-get install ${ARG_PACKAGE}, or configure with -D${option}=OFF")
  else()
    set(${ARG_RESULT} TRUE PARENT_SCOPE)
  endif()
endfunction()

# Notes that `part` is not built because `needs`, of the Debian package `package`, is missing.
function(albtpu_not_built part needs package)
  set_property(GLOBAL APPEND PROPERTY ALBTPU_NOT_BUILT "${part} (${needs} is missing)\; apt-get install ${package}")
endfunction()

# Writes a line for each part that is not built to not_built.txt in the build folder; to be called last.
function(albtpu_write_not_built)
  get_property(parts GLOBAL PROPERTY ALBTPU_NOT_BUILT)
  set(text "")
  foreach(part IN LISTS parts)
    string(APPEND text "not built: ${part}\n")
    message(STATUS "Not built: ${part}")
  endforeach()
  file(WRITE ${PROJECT_BINARY_DIR}/not_built.txt "${text}")
endfunction()
