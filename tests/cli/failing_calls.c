/* Preloaded into a program: of its system calls that write, the n-th (FAILING_CALL, from 1) fails
   with EIO, as on a disk that breaks. FAILING_LOG counts the calls, one byte for each. Calls on the
   standard streams do not count. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

static int fails(void)
{
  static int count;
  const char *const number = getenv("FAILING_CALL");
  const char *const log = getenv("FAILING_LOG");
  int (*const real_open)(const char *, int, ...) = (int (*)(const char *, int, ...))dlsym(RTLD_NEXT, "open");
  ssize_t (*const real_write)(int, const void *, size_t) =
      (ssize_t (*)(int, const void *, size_t))dlsym(RTLD_NEXT, "write");
  const int now = __atomic_add_fetch(&count, 1, __ATOMIC_SEQ_CST);
  if (log != NULL) {
    const int file = real_open(log, O_WRONLY | O_CREAT | O_APPEND, 0600);
    if (real_write(file, "x", 1) != 1) abort();
    close(file);
  }
  if (number == NULL || atoi(number) != now) return 0;
  errno = EIO;
  return 1;
}

#define FAILING(type, name, parameters, arguments)                                 \
  type name parameters                                                             \
  {                                                                                \
    type(*const real) parameters = (type(*) parameters)dlsym(RTLD_NEXT, #name);    \
    return fails() ? (type)-1 : real arguments;                                    \
  }

FAILING(int, fsync, (int file), (file))
FAILING(int, fchmod, (int file, mode_t mode), (file, mode))
FAILING(int, ftruncate, (int file, off_t size), (file, size))
FAILING(int, link, (const char *from, const char *to), (from, to))
FAILING(int, rename, (const char *from, const char *to), (from, to))
FAILING(int, mkdir, (const char *path, mode_t mode), (path, mode))
FAILING(ssize_t, pwrite, (int file, const void *data, size_t size, off_t at), (file, data, size, at))

ssize_t write(int file, const void *data, size_t size)
{
  ssize_t (*const real)(int, const void *, size_t) =
      (ssize_t (*)(int, const void *, size_t))dlsym(RTLD_NEXT, "write");
  if (file > 2 && fails()) return -1;
  return real(file, data, size);
}

int open(const char *path, int flags, ...)
{
  int (*const real)(const char *, int, ...) = (int (*)(const char *, int, ...))dlsym(RTLD_NEXT, "open");
  va_list more;
  mode_t mode;
  va_start(more, flags);
  mode = (flags & O_CREAT) ? va_arg(more, mode_t) : 0;
  va_end(more);
  if ((flags & O_ACCMODE) != O_RDONLY && fails()) return -1;
  return real(path, flags, mode);
}
