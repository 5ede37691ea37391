# What every target of ours is compiled with. Nothing global, so that a project that adds nade
# as a subdirectory keeps its own flags.
function(nade_target target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # For the shared library; where there is none it would only cost time.
  get_property(has_shared GLOBAL PROPERTY TARGET_SUPPORTS_SHARED_LIBS)
  set_target_properties(${target} PROPERTIES
    CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ${has_shared})
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-Wconversion;-Wshadow>)
  if(CMAKE_UNITY_BUILD)
    # GCC takes sources that are compiled together for headers.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
  if(NADE_SANITIZE)
    target_compile_options(${target} PRIVATE
      -fsanitize=${NADE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
      # Checks of each pointer that is followed are half the time, and most of what they would find
      # the address sanitizer does.
      -fno-sanitize=null,alignment,vptr,pointer-overflow,object-size
      # Sanitized code leads GCC to see what is not there; the plain build keeps these warnings.
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-mismatched-new-delete>)
    target_link_options(${target} PUBLIC -fsanitize=${NADE_SANITIZE})
    target_compile_definitions(${target} PRIVATE NADE_SANITIZED)
  endif()
endfunction()

# A shared library for C gives out nothing but what is marked for it and `map` lists.
function(nade_c_exports target map)
  if(MINGW)
    # All that it needs is Windows itself.
    target_link_options(${target} PRIVATE -static -Wl,--exclude-all-symbols -Wl,--gc-sections)
  elseif(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" AND UNIX AND NOT APPLE)
    target_link_options(${target} PRIVATE "-Wl,--version-script=${map}")
    set_property(TARGET ${target} PROPERTY LINK_DEPENDS "${map}")
    # A sanitizer's runtime is the program's, and not all of it is there when this is linked.
    if(NOT NADE_SANITIZE)
      target_link_options(${target} PRIVATE -Wl,--exclude-libs,ALL -Wl,--gc-sections -Wl,-z,defs)
    endif()
  endif()
endfunction()

# A program in C, as those have it who use nade.h.
function(nade_c_program target)
  set_target_properties(${target} PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE
    $<$<C_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra;-pedantic>)
  target_link_libraries(${target} PRIVATE nade::c)
  if(NADE_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${NADE_SANITIZE} -fno-sanitize-recover=all)
    # With clang only a C++ program has the sanitizers' runtime for C++.
    set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX)
  endif()
endfunction()
