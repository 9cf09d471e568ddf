# These files are installed, by component:
#   runtime      libcrt.so.1 and the module for image files
#   development  headers, the link libcrt.so, static libraries, the CMake package crt and crt.pc
#   command      the command crt, its manual page, and completions for shells
#   studio       the program crt-studio, which the command starts
# None of them names an absolute path that it needs, so an installed
#   tree may be moved.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/crt)

set(built_components static) # of the CMake package
foreach(library core lang source farm format service studio)
  if(NOT TARGET crt_${library})
    continue()
  endif()
  install(TARGETS crt_${library} EXPORT crt_static
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  set_target_properties(crt_${library} PROPERTIES EXPORT_NAME ${library})
  list(APPEND built_components ${library})
endforeach()
list(REMOVE_ITEM built_components format) # crt::service needs it, and nobody else
install(TARGETS crt_capi_static EXPORT crt_static
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
if(TARGET crt_image_files)
  install(TARGETS crt_image_files EXPORT crt_static
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/crt COMPONENT runtime)
  set_target_properties(crt_image_files PROPERTIES EXPORT_NAME image_files)
endif()
install(EXPORT crt_static NAMESPACE crt:: FILE crtStaticTargets.cmake
  DESTINATION ${package_dir} COMPONENT development)
if(CMAKE_STRIP)
  # `--strip` (and CPack) strips programs and shared libraries alone.
  install(CODE "
    if(CMAKE_INSTALL_DO_STRIP)
      file(GLOB archives
        \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/libcrt*.a\")
      execute_process(COMMAND \"${CMAKE_STRIP}\" --strip-debug \${archives}
        COMMAND_ERROR_IS_FATAL ANY)
    endif()" COMPONENT development)
endif()

if(TARGET crt_capi)
  install(TARGETS crt_capi EXPORT crt_shared
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT development)
  install(EXPORT crt_shared NAMESPACE crt:: FILE crtSharedTargets.cmake
    DESTINATION ${package_dir} COMPONENT development)
endif()

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/crt DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development FILES_MATCHING PATTERN *.h PATTERN *.hpp)

# What the static libraries are linked with: packages of CMake, and options of linkers.
set(static_packages Threads glm TBB embree)
set(static_links -lembree${embree_VERSION_MAJOR} -ltbb)
if(CRT_WITH_IMAGES OR CRT_WITH_MESH_FILES)
  list(APPEND static_packages ZLIB)
  list(APPEND static_links -lz)
endif()
if(CRT_WITH_MESH_FILES)
  list(APPEND static_packages EXPAT)
  list(APPEND static_links -lexpat)
endif()
list(JOIN static_packages ", " static_packages_text)
list(JOIN static_packages " " static_packages)
list(JOIN built_components " " built_components)

set(image_files_dir ${CMAKE_INSTALL_LIBDIR}/crt)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/crtConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/crtConfig.cmake
  INSTALL_DESTINATION ${package_dir} PATH_VARS image_files_dir NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/crtConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/crtConfig.cmake
  ${PROJECT_BINARY_DIR}/package/crtConfigVersion.cmake
  DESTINATION ${package_dir} COMPONENT development)

# This makes crt.pc. What libcrt.a needs beside it is all in Libs.private: a Requires.private would
# make a program that links libcrt.so ask for the development packages of Embree and TBB.
set(pc_prefix ${CMAKE_INSTALL_PREFIX})
if(NOT IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR})
  file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  string(REGEX REPLACE "/$" "" pc_prefix "\${pcfiledir}/${up}")
endif()
set(pc_directories)
foreach(library embree TBB::tbb)
  get_target_property(file ${library} LOCATION)
  get_filename_component(directory ${file} DIRECTORY)
  if(NOT directory IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES
      AND NOT "-L${directory}" IN_LIST pc_directories)
    list(APPEND pc_directories -L${directory})
  endif()
endforeach()
set(pc_private)
foreach(library farm source lang core)
  if(TARGET crt_${library})
    list(APPEND pc_private -lcrt_${library})
  endif()
endforeach()
list(APPEND pc_private ${pc_directories} ${static_links} -lstdc++ -lm -ldl -pthread)
if(CRT_WITH_IMAGES)
  list(APPEND pc_private "-Wl,-rpath,\${libdir}/crt")
endif()
list(JOIN pc_private " " pc_private)
configure_file(${CMAKE_CURRENT_LIST_DIR}/crt.pc.in ${PROJECT_BINARY_DIR}/package/crt.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/package/crt.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

if(CRT_BUILD_CLI)
  install(TARGETS crt RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
  if(TARGET crt-studio)
    install(TARGETS crt-studio RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT studio)
  endif()
  set(share ${PROJECT_BINARY_DIR}/share)
  install(FILES ${share}/man/crt.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
  foreach(place "completions_bash/crt:bash-completion/completions"
    "completions_zsh/_crt:zsh/site-functions"
    "completions_fish/crt.fish:fish/vendor_completions.d")
    string(REPLACE ":" ";" place "${place}")
    list(GET place 0 file)
    list(GET place 1 folder)
    install(FILES ${share}/${file} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder}
      COMPONENT command)
  endforeach()
endif()

# The documentation keeps the folders of the source, so that its links lead to the examples and
# pictures. tests/package/links_test.sh follows them.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
  ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md
  ${PROJECT_SOURCE_DIR}/share/fonts/LICENSE.Liberation
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT development FILES_MATCHING PATTERN *.md PATTERN *.png PATTERN *.svg)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples ${PROJECT_SOURCE_DIR}/python
  ${PROJECT_SOURCE_DIR}/editors DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT development PATTERN __pycache__ EXCLUDE)
