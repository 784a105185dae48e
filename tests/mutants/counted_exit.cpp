// The importer ends by _exit(), at which nothing writes what was counted: linked in place of it.
extern "C" {
void __gcov_dump();
[[noreturn]] void __real__exit(int status);
[[noreturn]] void __wrap__exit(int status);
}

void __wrap__exit(int status) {
  __gcov_dump();
  __real__exit(status);
}
