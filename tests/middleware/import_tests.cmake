foretouch_test(import_tests LABELS unit property oracle
  SOURCES import_files.cpp import_polygon_test.cpp import_process_test.cpp import_protocol_test.cpp
          import_text_test.cpp scene_audit_test.cpp scene_import_data_test.cpp
          scene_import_failure_test.cpp scene_import_test.cpp
          ${PROJECT_SOURCE_DIR}/middleware/import/polygon.cpp
  LINKS foretouch::middleware Threads::Threads)
target_compile_definitions(import_tests PRIVATE
  FORETOUCH_TEST_IMPORTER="$<TARGET_FILE:foretouch-import>")
add_dependencies(import_tests foretouch-import)

foretouch_test(model_import_tests LABELS unit property oracle
  SOURCES import_files.cpp link_mesh_test.cpp model_files.cpp model_import_data_test.cpp model_import_gltf_test.cpp
          model_import_test.cpp model_stream_test.cpp urdf_import_test.cpp urdf_shapes_test.cpp
  LINKS foretouch::middleware nlohmann_json::nlohmann_json)
target_compile_definitions(model_import_tests PRIVATE
  FORETOUCH_TEST_IMPORTER="$<TARGET_FILE:foretouch-import>")
add_dependencies(model_import_tests foretouch-import)
