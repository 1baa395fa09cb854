# `make install` and `make package`: the two programs, the Python modules, the shipped cases, what advise and ablate read,
# man pages and completion. Both are made of the programs' own --help when they are installed. The reference, where it is
# built, is installed too; the package is without it, since it would not go without LIGGGHTS and OpenFOAM.
include(GNUInstallDirs)

set(share ${CMAKE_INSTALL_DATADIR}/granvof)
install(TARGETS granvof_program granvof-compare RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES solver/python/granvof.py solver/python/granvof_files.py DESTINATION lib/python3/dist-packages)
install(DIRECTORY cases DESTINATION ${share})
install(FILES compare/checks.toml compare/study.toml DESTINATION ${share}/compare)
# What `granvof report` and `granvof sweep` hand over to; they look for the modules beside themselves.
install(PROGRAMS compare/show compare/sweep DESTINATION ${share}/compare)
install(FILES compare/engine/__init__.py compare/engine/client.py DESTINATION ${share}/compare/engine)
install(FILES ci/night/__init__.py ci/night/together.py DESTINATION ${share}/ci/night)
install(DIRECTORY compare/report DESTINATION ${share}/compare PATTERN __pycache__ EXCLUDE)
install(DIRECTORY solver/python DESTINATION ${share}/solver PATTERN __pycache__ EXCLUDE)
install(FILES compare/kept/verify/results.json DESTINATION ${share}/compare/kept/verify)
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

find_program(GRANVOF_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
function(install_manuals component)
  set(manuals ${CMAKE_BINARY_DIR}/manuals/${component})
  list(TRANSFORM ARGN REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE programs)
  list(JOIN programs " " programs)
  install(CODE "
    execute_process(COMMAND ${GRANVOF_PYTHON} ${CMAKE_SOURCE_DIR}/ci/manuals
      --out ${manuals} ${programs} COMMAND_ERROR_IS_FATAL ANY)" COMPONENT ${component})
  install(DIRECTORY ${manuals}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT ${component})
  install(DIRECTORY ${manuals}/bash/ DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT ${component})
endfunction()
install_manuals(Unspecified granvof_program granvof-compare)
if(TARGET demvof)
  set_target_properties(demvof PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}/granvof")
  install(TARGETS demvof RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT reference)
  install(TARGETS demvof_environment LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/granvof COMPONENT reference)
  install_manuals(reference demvof)
endif()

set(CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_BINARY_DIR};${PROJECT_NAME};Unspecified;/")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the authors of granvof")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-h5py, python3-xarray, python3-matplotlib, python3-jinja2")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
include(CPack)
