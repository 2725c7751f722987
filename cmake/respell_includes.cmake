# Runs at installation: changes "tables/file/table_io.h" to "albtpu/tables/table_io.h" in the #include lines of the
# installed `headers` in `folder`.
foreach(header IN LISTS headers)
  cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY "${CMAKE_INSTALL_PREFIX}" OUTPUT_VARIABLE installed)
  set(installed "$ENV{DESTDIR}${installed}/${header}")
  file(READ "${installed}" text)
  string(REGEX REPLACE "(#include \")(budget|tables|sea|service/client|service/seas)/([a-z]+/)?" "\\1albtpu/\\2/"
         text "${text}")
  file(WRITE "${installed}" "${text}")
endforeach()
