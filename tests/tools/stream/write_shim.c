/* Preloaded into a service whose log's disk is to fail: what FORETOUCH_WRITE_FAULT says befalls each
 * pwrite() after the first one. short: half of the bytes are written; full: none, ENOSPC; stall: the
 * call returns after an hour. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

static ssize_t written(int file, const void* bytes, size_t size, off_t at) {
  static ssize_t (*real)(int, const void*, size_t, off_t);
  static int calls;
  const char* fault = getenv("FORETOUCH_WRITE_FAULT");
  if (!real) real = (ssize_t(*)(int, const void*, size_t, off_t))dlsym(RTLD_NEXT, "pwrite");
  if (!fault || ++calls == 1) return real(file, bytes, size, at);
  if (!strcmp(fault, "short") && size > 1) return real(file, bytes, size / 2, at);
  if (!strcmp(fault, "full")) {
    errno = ENOSPC;
    return -1;
  }
  if (!strcmp(fault, "stall")) {
    struct timespec hour = {3600, 0};
    nanosleep(&hour, NULL);
  }
  return real(file, bytes, size, at);
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  return written(file, bytes, size, at);
}
ssize_t pwrite64(int file, const void* bytes, size_t size, off_t at) {
  return written(file, bytes, size, at);
}
