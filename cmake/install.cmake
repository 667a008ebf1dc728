# What `cmake --install` puts where. The tree may be moved as a whole: programs find their libraries and ready cells beside themselves.
#
#     bin                        programs
#     lib                        shared libraries; lib/cmake/Corpuscle for find_package(Corpuscle)
#     include/corpuscle          headers
#     share/corpuscle            cells, schema, tutorials, docs, Python package in python/
#     share/man, share/bash-completion
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(data ${CMAKE_INSTALL_DATADIR}/corpuscle)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/Corpuscle)

install(DIRECTORY ${CMAKE_SOURCE_DIR}/libs/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/corpuscle COMPONENT corpuscle FILES_MATCHING PATTERN "*.hpp")
install(EXPORT CorpuscleTargets NAMESPACE corpuscle:: DESTINATION ${config} COMPONENT corpuscle)
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/CorpuscleConfig.cmake.in ${CMAKE_BINARY_DIR}/CorpuscleConfig.cmake INSTALL_DESTINATION ${config})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/CorpuscleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/CorpuscleConfig.cmake ${CMAKE_BINARY_DIR}/CorpuscleConfigVersion.cmake ${CMAKE_SOURCE_DIR}/cmake/CorpusclePlugin.cmake
    DESTINATION ${config} COMPONENT corpuscle)

# Where readyCell looks beside a program, and where everything else lies as in the repository.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/etc/cells ${CMAKE_SOURCE_DIR}/etc/schema ${CMAKE_SOURCE_DIR}/etc/models DESTINATION ${data} COMPONENT corpuscle)
install(PROGRAMS ${CMAKE_SOURCE_DIR}/etc/newModel DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT corpuscle)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/python DESTINATION ${data} COMPONENT corpuscle PATTERN __pycache__ EXCLUDE)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION ${data} COMPONENT corpuscle PATTERN __pycache__ EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/CHANGELOG.md ${CMAKE_SOURCE_DIR}/LICENSE ${CMAKE_SOURCE_DIR}/CITATION.cff
    DESTINATION ${data} COMPONENT corpuscle)
# What these pages link to, as in the repository: pages, pictures and reference data of validation and benchmarks.
set(linked "")
foreach(pattern tests/*.md tests/*.png tests/validation/*.csv benchmarks/*.md benchmarks/*.png benchmarks/*.svg benchmarks/*.csv etc/cells/*)
    file(GLOB_RECURSE found RELATIVE ${CMAKE_SOURCE_DIR} CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${pattern})
    list(APPEND linked ${found})
endforeach()
foreach(page CONTRIBUTING.md tests/validation/sphereNearWall/wallBox.py ${linked})
    get_filename_component(folder ${page} DIRECTORY)
    install(FILES ${CMAKE_SOURCE_DIR}/${page} DESTINATION ${data}/${folder} COMPONENT corpuscle)
endforeach()
# Of the tutorials what is under version control; what runs have left is not.
install(CODE "
    execute_process(COMMAND git -C \"${CMAKE_SOURCE_DIR}\" ls-files tutorials OUTPUT_VARIABLE listed RESULT_VARIABLE failed ERROR_QUIET)
    if(failed OR NOT listed)
        file(GLOB_RECURSE files RELATIVE \"${CMAKE_SOURCE_DIR}\" \"${CMAKE_SOURCE_DIR}/tutorials/*\")
    else()
        string(REPLACE \"\\n\" \";\" files \"\${listed}\")
    endif()
    foreach(file \${files})
        if(EXISTS \"${CMAKE_SOURCE_DIR}/\${file}\")
            get_filename_component(folder \"\${file}\" DIRECTORY)
            file(INSTALL \"${CMAKE_SOURCE_DIR}/\${file}\" DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${data}/\${folder}\" USE_SOURCE_PERMISSIONS)
        endif()
    endforeach()
" COMPONENT corpuscle)

# Man pages and completion, from the options that the programs declare.
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
    get_property(programs GLOBAL PROPERTY CORPUSCLE_PROGRAMS)
    set(manual ${CMAKE_BINARY_DIR}/manual)
    add_custom_command(OUTPUT ${manual}/stamp COMMAND ${CMAKE_COMMAND} -E rm -rf ${manual}
        COMMAND ${CMAKE_COMMAND} -E env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/etc/makeManual
            ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${manual}
        COMMAND ${CMAKE_COMMAND} -E touch ${manual}/stamp
        DEPENDS ${programs} ${CMAKE_SOURCE_DIR}/etc/makeManual COMMENT "Man pages and completion" VERBATIM)
    add_custom_target(manual ALL DEPENDS ${manual}/stamp)
    install(DIRECTORY ${manual}/man1 ${manual}/man7 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT corpuscle)
    install(DIRECTORY ${manual}/bash-completion/ DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT corpuscle)
endif()

# cpack -G DEB in the build folder. Run-time libraries are found by dpkg-shlibdeps.
set(CPACK_PACKAGE_NAME corpuscle)
set(CPACK_PACKAGE_VENDOR "The Corpuscle developers")
set(CPACK_PACKAGE_CONTACT "The Corpuscle developers <corpuscle@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-pandas, python3-matplotlib, python3-yaml, gnuplot-nox, fonts-dejavu-core, libegl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "paraview, ffmpeg, libopenmpi-dev, libeigen3-dev, libfmt-dev, nlohmann-json3-dev, cmake, g++")
set(CPACK_COMPONENTS_ALL corpuscle)
set(CPACK_DEB_COMPONENT_INSTALL OFF)
set(CPACK_GENERATOR DEB)
include(CPack)
