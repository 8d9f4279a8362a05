# Installs the programs, the shipped model, and the client library as a CMake package (find_package(choreo), target
# choreo::client). examples/client uses it; scripts/verify.sh tries it. The component `programs` is what a server needs (docker/).
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/choreo)
install(TARGETS choreo RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
install(TARGETS choreo_client choreo_motion choreo_rounded choreo_network choreo_proto choreo_wire EXPORT choreoTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/choreo)
install(FILES client/choreo_client.h client/dance_config.h client/dance_messages.h client/edit.h client/server_description.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/choreo/client)
install(FILES model/core/error.h model/core/grid.h model/core/hand_pose.h model/core/hit.h model/core/joined.h model/core/limits.h model/core/passage.h model/core/range.h model/core/rounded.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/choreo/model/core)
install(FILES network/protocol.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/choreo/network)
install(FILES model/messages/call_timing.h model/messages/dance_event.h model/messages/dance_header.h model/messages/dance_manner.h model/messages/model_description.h model/messages/quality_report.h model/messages/style_figures.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/choreo/model/messages)
# What these headers include, and the pose at rest, from which key poses are made.
install(FILES model/motion/motion.h model/motion/skeleton.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/choreo/model/motion)
install(FILES model/motion/kinematics/kinematics.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/choreo/model/motion/kinematics)
install(FILES model/motion/controls/control_request.h model/motion/controls/velocity_factors.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/choreo/model/motion/controls)
install(DIRECTORY proto/choreo DESTINATION ${CMAKE_INSTALL_DATADIR}/choreo/proto FILES_MATCHING PATTERN "*.proto")
install(DIRECTORY model/checkpoints DESTINATION ${CMAKE_INSTALL_DATADIR}/choreo COMPONENT programs)
configure_file(docker/choreod.service.in ${CMAKE_BINARY_DIR}/choreod.service @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/choreod.service DESTINATION lib/systemd/system COMPONENT systemd)
install(EXPORT choreoTargets NAMESPACE choreo:: DESTINATION ${package_dir})
configure_package_config_file(cmake/choreoConfig.cmake.in ${CMAKE_BINARY_DIR}/choreoConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/choreoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/choreoConfig.cmake ${CMAKE_BINARY_DIR}/choreoConfigVersion.cmake DESTINATION ${package_dir})
