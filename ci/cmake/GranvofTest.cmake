# Where the shipped cases lie: the one object that holds a path of this checkout.
add_library(granvof_cases_directory STATIC ${CMAKE_SOURCE_DIR}/solver/tests/cases_directory.cpp)
target_link_libraries(granvof_cases_directory PRIVATE granvof_options)
target_compile_definitions(granvof_cases_directory PRIVATE GRANVOF_CASES_DIR="${CMAKE_SOURCE_DIR}/cases")
set_target_properties(granvof_cases_directory PROPERTIES EXCLUDE_FROM_ALL ON)

# granvof_test(NAME <target> LABEL unit|verification SOURCES <files> LIBS <libraries>)
# builds one GoogleTest program; each of its tests becomes a ctest test with that label.
function(granvof_test)
  cmake_parse_arguments(ARG "" "NAME;LABEL" "SOURCES;LIBS" ${ARGN})
  add_executable(${ARG_NAME} ${ARG_SOURCES})
  target_link_libraries(${ARG_NAME} PRIVATE granvof_options granvof_cases_directory ${ARG_LIBS} GTest::gtest GTest::gtest_main)
  # Half of a build is GoogleTest's templates, which gain nothing from optimisation; the libraries keep theirs.
  target_compile_options(${ARG_NAME} PRIVATE $<$<CONFIG:Release>:-O1>)
  # Parameters are named by their index: some print as raw memory, different in every build.
  gtest_discover_tests(${ARG_NAME} DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES PROPERTIES LABELS ${ARG_LABEL} TIMEOUT 900
                       ENVIRONMENT OMP_NUM_THREADS=1)
endfunction()
