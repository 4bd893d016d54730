# How all of our own code is compiled. Linked privately, so that it never reaches generated code.
add_library(slod_options INTERFACE)
target_compile_options(slod_options INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor
    -ffp-contract=off)      # same bits on every machine; see ARCHITECTURE.md, Determinism

# What kernels are built for besides the baseline; simd/kernels.cpp asks the processor for the same.
set(slod_v3_options -mavx2 -mfma -mbmi -mbmi2)
set(slod_v4_options ${slod_v3_options} -mavx512f -mavx512bw -mavx512cd -mavx512dq -mavx512vl
    -mprefer-vector-width=512)

option(SLOD_VALIDATE "Check every structure's invariants after each phase (slow)" OFF)
if(SLOD_VALIDATE)
    target_compile_definitions(slod_options INTERFACE SLOD_VALIDATE)
endif()

option(SLOD_PLAIN_THREADS "Run parallel loops on std::jthread: ThreadSanitizer cannot see into libtbb" OFF)

# slod_layer(<folder> SOURCES <files> [DEPENDS <libraries>] [PRIVATE <libraries>]): one library slod_<name> per folder.
# Its headers are found only by those who link it: the include root of a layer is a folder of its
# own that holds nothing but a link to the layer, so an include against the arrows does not build.
function(slod_layer name)
    cmake_parse_arguments(LAYER "" "" "SOURCES;DEPENDS;PRIVATE" ${ARGN})
    set(root ${CMAKE_BINARY_DIR}/layers/${name})
    file(MAKE_DIRECTORY ${root})
    file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${root}/${name} SYMBOLIC)
    if(LAYER_SOURCES)
        add_library(slod_${name} STATIC ${LAYER_SOURCES})
        target_include_directories(slod_${name} PUBLIC ${root})
        target_link_libraries(slod_${name} PUBLIC ${LAYER_DEPENDS} PRIVATE ${LAYER_PRIVATE} slod_options)
    else()
        add_library(slod_${name} INTERFACE)
        target_include_directories(slod_${name} INTERFACE ${root})
        target_link_libraries(slod_${name} INTERFACE ${LAYER_DEPENDS})
    endif()
endfunction()
