# palacectl: the same engine with no window. Its simulated pictures need GL, so it comes with the GUI
# rooms; engine-only builds (sanitizers) leave it out.
palace_room(survey engine/survey palace_slad palace_geodata palace_camera)
palace_room(experiments engine/experiments palace_capture palace_report palace_calibration palace_runtime palace_simulation palace_faults palace_journal palace_survey)
target_include_directories(palace_experiments SYSTEM PRIVATE ${CLI11_INCLUDE_DIR})
# OpenCV's contrib trackers are peers there; that library alone, not what its target would bring along.
if(NOT TARGET opencv_tracking)
  message(FATAL_ERROR "OpenCV lacks its contrib module \"tracking\" (Debian: libopencv-contrib-dev, which libopencv-dev brings)")
endif()
target_link_libraries(palace_experiments PRIVATE $<TARGET_FILE:opencv_tracking>)
palace_precompile(survey experiments)
if(NOT PALACE_ENGINE_ONLY)
  file(GLOB PALACE_TOOLS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/engine/tools/*.cpp)
  add_executable(palacectl ${PALACE_TOOLS})
  target_link_libraries(palacectl PRIVATE palace_experiments palace_capture palace_journal palace_platform palace_render
    nlohmann_json::nlohmann_json ${OPENGL_LIBRARY})
  target_include_directories(palacectl SYSTEM PRIVATE ${CLI11_INCLUDE_DIR})
  install(TARGETS palacectl RUNTIME DESTINATION bin)
endif()
