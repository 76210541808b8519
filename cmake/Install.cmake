# `cmake --install`: component "program" is bookspin and its files, component "library" all of bookspin::dynamics.
# `make package` (cpack): a Debian package for each.
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/bookspin)
include(CMakePackageConfigHelpers)

if(BOOKSPIN_PROGRAM)
  set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
  install(TARGETS bookspin)
  install(DIRECTORY shaders textures data DESTINATION ${CMAKE_INSTALL_DATADIR}/bookspin)
  install(DIRECTORY videos DESTINATION ${CMAKE_INSTALL_DATADIR}/bookspin PATTERN site EXCLUDE PATTERN *.py EXCLUDE)
  install(FILES ${PROJECT_BINARY_DIR}/live/live.wasm DESTINATION ${CMAKE_INSTALL_DATADIR}/bookspin/live OPTIONAL)
  install(FILES LICENSE NOTICE.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

  # What the program prints of itself.
  set(printed ${PROJECT_BINARY_DIR}/printed)
  add_custom_command(OUTPUT ${printed}/scene.schema.json
    COMMAND ${CMAKE_COMMAND} -E make_directory ${printed}
    COMMAND bookspin help man >${printed}/bookspin.1
    COMMAND gzip -9nf ${printed}/bookspin.1
    COMMAND bookspin completion bash >${printed}/bookspin
    COMMAND bookspin completion zsh >${printed}/_bookspin
    COMMAND bookspin schema >${printed}/scene.schema.json DEPENDS bookspin)
  add_custom_target(bookspin_printed ALL DEPENDS ${printed}/scene.schema.json)
  install(FILES ${printed}/bookspin.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${printed}/bookspin DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${printed}/_bookspin DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
  install(FILES ${printed}/scene.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/bookspin)
endif()

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME library)
install(TARGETS bookspin_dynamics bookspin_c EXPORT bookspin
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${CMAKE_INSTALL_INCLUDEDIR}/bookspin
  LIBRARY NAMELINK_COMPONENT library)
install(DIRECTORY src/dynamics DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/bookspin FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_BINARY_DIR}/single_header/bookspin_dynamics.h TYPE INCLUDE)
install(EXPORT bookspin NAMESPACE bookspin:: FILE bookspinTargets.cmake DESTINATION ${package_dir})
install(FILES LICENSE NOTICE.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libbookspin-dev)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libbookspin-dev RENAME copyright)

file(CONFIGURE OUTPUT bookspinConfig.cmake CONTENT [[
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 NO_MODULE)
include(${CMAKE_CURRENT_LIST_DIR}/bookspinTargets.cmake)
]] @ONLY)
write_basic_package_version_file(bookspinConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bookspinConfig.cmake ${PROJECT_BINARY_DIR}/bookspinConfigVersion.cmake DESTINATION ${package_dir})

# Beside the static library stands the shared one of the same name, which has the C interface alone.
file(RELATIVE_PATH prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
file(CONFIGURE OUTPUT bookspin-dynamics.pc CONTENT [[
prefix=${pcfiledir}/@prefix@
libdir=${prefix}/@CMAKE_INSTALL_LIBDIR@
includedir=${prefix}/@CMAKE_INSTALL_INCLUDEDIR@

Name: bookspin-dynamics
Description: The torque-free motion of a rigid body in closed form, and integrators of it
Version: @PROJECT_VERSION@
Requires: eigen3 >= 3.4
Libs: -L${libdir} -l:libbookspin_dynamics.a
Cflags: -I${includedir} -I${includedir}/bookspin -DEIGEN_DONT_VECTORIZE
]] @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/bookspin-dynamics.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL library)
if(BOOKSPIN_PROGRAM)
  list(PREPEND CPACK_COMPONENTS_ALL program)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "The authors of bookspin <bookspin@localhost>")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME bookspin)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "films of a tumbling book
Scene scripts become films of a tumbling book, a course page around them,
and a report on the accuracy of the integrators.")
# Opened by path or by dlopen, so that no library names them. OpenGL off the screen is OSMesa's or EGL's.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "fonts-inter, libosmesa6 | libegl1, libosmesa6 | libgl1-mesa-dri")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libbookspin-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "exact torque-free rotation of a rigid body
The motion in closed form at any time, and integrators of it: for C++ with
Eigen as a library or as a single header, and a C interface.")
include(CPack)
