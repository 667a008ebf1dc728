# corpuscle_plugin(NAME SOURCES a.cpp ... DEPENDS membrane ...)
#
# A library NAME.so of models that a case loads by `libs: [NAME.so]`. DEPENDS are libraries of Corpuscle whose headers it uses.
function(corpuscle_plugin NAME)
    cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
    set(version ${CMAKE_CURRENT_BINARY_DIR}/${NAME}Version.cpp)
    file(CONFIGURE OUTPUT ${version} CONTENT
        "extern \"C\" const char* corpusclePluginVersion();\nextern \"C\" const char* corpusclePluginVersion() { return \"@Corpuscle_VERSION@\"; }\n" @ONLY)
    add_library(${NAME} MODULE ${ARG_SOURCES} ${version})
    foreach(dependency ${ARG_DEPENDS})
        target_link_libraries(${NAME} PRIVATE corpuscle::${dependency})
    endforeach()
    target_compile_features(${NAME} PRIVATE cxx_std_20)
    target_compile_definitions(${NAME} PRIVATE OMPI_SKIP_MPICXX=1)
    set_target_properties(${NAME} PROPERTIES PREFIX "" CXX_EXTENSIONS OFF)
endfunction()
