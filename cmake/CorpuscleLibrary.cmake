# corpuscle_library(NAME SOURCES a.cpp ... DEPENDS core ... LINK Foreign::target ...)
#
# A shared library corpuscle_NAME from libs/NAME; DEPENDS are other Corpuscle libraries (only those that
# docs/architecture.md allows: tests/architecture checks it), LINK are packages whose types stand in public headers,
# PRIVATE_LINK packages that only the sources see. Shared, so that laws which only register themselves are kept.
function(corpuscle_library NAME)
    cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LINK;PRIVATE_LINK" ${ARGN})
    add_library(corpuscle_${NAME} SHARED ${ARG_SOURCES})
    add_library(corpuscle::${NAME} ALIAS corpuscle_${NAME})
    target_link_libraries(corpuscle_${NAME} PRIVATE corpuscle_options ${ARG_PRIVATE_LINK})
    target_link_libraries(corpuscle_${NAME} PUBLIC ${ARG_LINK})
    foreach(dependency ${ARG_DEPENDS})
        target_link_libraries(corpuscle_${NAME} PUBLIC corpuscle::${dependency})
    endforeach()
    target_include_directories(corpuscle_${NAME} PUBLIC ${CMAKE_SOURCE_DIR}/libs)
    target_link_options(corpuscle_${NAME} PUBLIC -Wl,--no-as-needed)
endfunction()

# corpuscle_application(NAME SOURCES main.cpp DEPENDS simulation ...)
function(corpuscle_application NAME)
    cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LINK" ${ARGN})
    add_executable(${NAME} ${ARG_SOURCES})
    target_link_libraries(${NAME} PRIVATE corpuscle_options ${ARG_LINK})
    foreach(dependency ${ARG_DEPENDS})
        target_link_libraries(${NAME} PRIVATE corpuscle::${dependency})
    endforeach()
endfunction()

# corpuscle_test(NAME SOURCES a.cpp ... DEPENDS library ... [RANKS 1 2 4] [GROUP fast|mpi|physics])
# One GoogleTest executable; RANKS adds one ctest entry per number of ranks, run through mpirun.
function(corpuscle_test NAME)
    cmake_parse_arguments(ARG "" "GROUP" "SOURCES;DEPENDS;LINK;RANKS" ${ARGN})
    if(NOT ARG_GROUP)
        set(ARG_GROUP fast)
    endif()
    add_executable(test_${NAME} ${ARG_SOURCES})
    target_link_libraries(test_${NAME} PRIVATE corpuscle_options GTest::gtest ${ARG_LINK})
    foreach(dependency ${ARG_DEPENDS})
        target_link_libraries(test_${NAME} PRIVATE corpuscle::${dependency})
    endforeach()
    target_include_directories(test_${NAME} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
    target_compile_definitions(test_${NAME} PRIVATE
        CORPUSCLE_SOURCE_DIR="${CMAKE_SOURCE_DIR}" CORPUSCLE_BINARY_DIR="${CMAKE_BINARY_DIR}")
    if(ARG_RANKS)
        foreach(n ${ARG_RANKS})
            add_test(NAME ${NAME}.np${n} COMMAND ${MPIEXEC_EXECUTABLE} --oversubscribe -np ${n} $<TARGET_FILE:test_${NAME}>)
            set_tests_properties(${NAME}.np${n} PROPERTIES LABELS ${ARG_GROUP} PROCESSORS 2 ENVIRONMENT
                "OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_rmaps_base_oversubscribe=1")
        endforeach()
    else()
        add_test(NAME ${NAME} COMMAND test_${NAME})
        set_tests_properties(${NAME} PROPERTIES LABELS ${ARG_GROUP})
    endif()
endfunction()

# corpuscle_isa_sources(NAME file.cpp ...): adds each file to the library three times, built for baseline x86-64, AVX2 and
# AVX-512 (libs/particles/isa.hpp chooses at run time). On other processors only the baseline is built.
function(corpuscle_isa_sources NAME)
    set(sets baseline)
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
        list(APPEND sets avx2 avx512)
        target_compile_definitions(corpuscle_${NAME} PRIVATE CORPUSCLE_X86)
    endif()
    set(flags_baseline "")
    set(flags_avx2 -mavx2 -mfma)
    set(flags_avx512 -mavx512f -mavx512dq -mavx512vl -mfma -mprefer-vector-width=512)
    set(tag_baseline Baseline)
    set(tag_avx2 Avx2)
    set(tag_avx512 Avx512)
    foreach(set ${sets})
        add_library(corpuscle_${NAME}_${set} OBJECT ${ARGN})
        set_target_properties(corpuscle_${NAME}_${set} PROPERTIES POSITION_INDEPENDENT_CODE ON)
        target_link_libraries(corpuscle_${NAME}_${set} PRIVATE corpuscle_options Eigen3::Eigen)
        # A 64-byte vector passes through no function boundary here: everything is inlined (-Wno-psabi);
        # g++ 12's own AVX-512 header misfires on -Wmaybe-uninitialized.
        target_compile_options(corpuscle_${NAME}_${set} PRIVATE ${flags_${set}} -ffp-contract=fast -Wno-psabi
            -Wno-maybe-uninitialized)
        # Everything is inlined: with checks at every access the compiler takes more than five minutes a file.
        if(CORPUSCLE_SANITIZE)
            target_compile_options(corpuscle_${NAME}_${set} PRIVATE -fno-sanitize=all)
        endif()
        target_compile_definitions(corpuscle_${NAME}_${set} PRIVATE
            CORPUSCLE_ISA_NAMESPACE=${set} CORPUSCLE_ISA_TAG=::corpuscle::particles::isa::${tag_${set}})
        target_sources(corpuscle_${NAME} PRIVATE $<TARGET_OBJECTS:corpuscle_${NAME}_${set}>)
    endforeach()
endfunction()
