foretouch_test(import_tests LABELS unit property oracle
  SOURCES import_files.cpp import_polygon_test.cpp import_process_test.cpp import_protocol_test.cpp
          import_text_test.cpp scene_audit_test.cpp scene_import_data_test.cpp
          scene_import_failure_test.cpp scene_import_test.cpp
          ${PROJECT_SOURCE_DIR}/middleware/import_polygon.cpp
  LINKS foretouch::middleware Threads::Threads)
target_compile_definitions(import_tests PRIVATE
  FORETOUCH_TEST_IMPORTER="$<TARGET_FILE:foretouch-import>")
add_dependencies(import_tests foretouch-import)
