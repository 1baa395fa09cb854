/* Put before the C library (LD_PRELOAD) by ci/faults: counts the calls that change files, and lets the one asked for go wrong.
 *
 *   FAULT_COUNT=FILE   writes into FILE how many calls there were, at the end of the program
 *   FAULT_CALL=N       the N-th call is killed (SIGKILL), a write after half of its bytes; FAULT_ERRNO=E: it fails with E;
 *                      FAULT_SIGNAL=S: that signal comes before it, and it is done
 *   FAULT_BYTES=N      a disk with N bytes left: what goes beyond is cut off, then fails with ENOSPC
 *   FAULT_READ=N       the N-th read of a file below FAULT_BELOW fails with FAULT_ERRNO, or EIO; FAULT_COUNT counts these then
 *   FAULT_LOCK=E       a file system without locks: asking for one fails with E
 *   FAULT_CLOCK=1      the clock of the day goes back an hour each time it is read
 *
 * Standard streams are let off, and so is what is no file, such as the descriptor by which MPI wakes its thread: that
 * takes no room, and without it the thread waits for ever. The program has one thread; a process that it makes counts on from where it was made,
 * its calls fail and are not killed: a kill is the whole program's. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static long calls = 0;
static long long bytes_left = -1;
static pid_t begun_as = 0;

static long number(const char* name) {
  const char* given = getenv(name);
  return given ? atol(given) : 0;
}

static void* next(const char* name) {
  return dlsym(RTLD_NEXT, name);
}

__attribute__((constructor)) static void begin(void) {
  begun_as = getpid();
  if (getenv("FAULT_BYTES")) bytes_left = atoll(getenv("FAULT_BYTES"));
}

__attribute__((destructor)) static void end(void) {
  const char* path = getenv("FAULT_COUNT");
  if (!path) return;
  FILE* file = fopen(path, "w");
  if (!file) return;
  fprintf(file, "%ld\n", calls);
  fclose(file);
}

static int is_due(void) {
  if (getenv("FAULT_READ")) return 0;
  ++calls;
  if (calls != number("FAULT_CALL")) return 0;
  if (number("FAULT_SIGNAL") != 0) {
    if (getpid() == begun_as) raise((int)number("FAULT_SIGNAL"));
    return 0;
  }
  return getpid() == begun_as || number("FAULT_ERRNO") != 0;
}

/* Does not return where the call is to be killed. */
static int fail(void) {
  const long error = number("FAULT_ERRNO");
  if (error == 0) kill(getpid(), SIGKILL);
  errno = (int)error;
  return -1;
}

typedef ssize_t (*Write)(int, const void*, size_t);
typedef ssize_t (*Pwrite)(int, const void*, size_t, off_t);

/* How many of `size` bytes go through; -1 with errno where none does. A call that is due has `due` set. */
static ssize_t allowed(int fd, size_t size, int* due) {
  *due = 0;
  struct stat what;
  if (fd <= STDERR_FILENO || (fstat(fd, &what) == 0 && !S_ISREG(what.st_mode))) return (ssize_t)size;
  *due = is_due();
  if (bytes_left < 0 && *due) return number("FAULT_ERRNO") == EINTR ? 0 : (ssize_t)(size / 2); /* broken off: nothing yet */
  if (bytes_left < 0) return (ssize_t)size;
  if (bytes_left == 0 && size > 0) {
    errno = ENOSPC;
    return -1;
  }
  const size_t passed = size < (size_t)bytes_left ? size : (size_t)bytes_left;
  bytes_left -= (long long)passed;
  return (ssize_t)passed;
}

ssize_t write(int fd, const void* data, size_t size) {
  int due;
  const ssize_t passed = allowed(fd, size, &due);
  const ssize_t done = passed < 0 ? passed : ((Write)next("write"))(fd, data, (size_t)passed);
  return due ? fail() : done;
}

static ssize_t write_at(const char* name, int fd, const void* data, size_t size, off_t offset) {
  int due;
  const ssize_t passed = allowed(fd, size, &due);
  const ssize_t done = passed < 0 ? passed : ((Pwrite)next(name))(fd, data, (size_t)passed, offset);
  return due ? fail() : done;
}

ssize_t pwrite(int fd, const void* data, size_t size, off_t offset) {
  return write_at("pwrite", fd, data, size, offset);
}

ssize_t pwrite64(int fd, const void* data, size_t size, off_t offset) {
  return write_at("pwrite64", fd, data, size, offset);
}

static int reserve(int fd, off_t offset, off_t size) {
  if (is_due()) return fail() ? errno : 0;
  if (bytes_left >= 0 && size > bytes_left) return ENOSPC;
  return ((int (*)(int, off_t, off_t))next("posix_fallocate"))(fd, offset, size);
}

int posix_fallocate(int fd, off_t offset, off_t size) {
  return reserve(fd, offset, size);
}

int posix_fallocate64(int fd, off_t offset, off_t size) {
  return reserve(fd, offset, size);
}

static int open_file(const char* name, const char* path, int flags, mode_t mode) {
  if ((flags & (O_WRONLY | O_RDWR | O_CREAT)) && strncmp(path, "/dev/", 5) != 0 && is_due()) return fail();
  return ((int (*)(const char*, int, mode_t))next(name))(path, flags, mode);
}

static mode_t mode_of(int flags, va_list more) {
  return flags & O_CREAT ? (mode_t)va_arg(more, int) : 0;
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return open_file("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return open_file("open64", path, flags, mode);
}

static int on_name(const char* call, const char* path) {
  return is_due() ? fail() : ((int (*)(const char*))next(call))(path);
}

int unlink(const char* path) {
  return on_name("unlink", path);
}

int rmdir(const char* path) {
  return on_name("rmdir", path);
}

int remove(const char* path) {
  return on_name("remove", path);
}

int mkdir(const char* path, mode_t mode) {
  return is_due() ? fail() : ((int (*)(const char*, mode_t))next("mkdir"))(path, mode);
}

int rename(const char* from, const char* to) {
  return is_due() ? fail() : ((int (*)(const char*, const char*))next("rename"))(from, to);
}

static int on_descriptor(const char* call, int fd) {
  return fd > STDERR_FILENO && is_due() ? fail() : ((int (*)(int))next(call))(fd);
}

int fsync(int fd) {
  return on_descriptor("fsync", fd);
}

int close(int fd) {
  return on_descriptor("close", fd);
}

int ftruncate(int fd, off_t size) {
  return is_due() ? fail() : ((int (*)(int, off_t))next("ftruncate"))(fd, size);
}

int ftruncate64(int fd, off_t size) {
  return is_due() ? fail() : ((int (*)(int, off_t))next("ftruncate64"))(fd, size);
}

/* Whether a read is the one to fail: of a regular file below FAULT_BELOW. */
static int read_is_due(int fd) {
  const char* below = getenv("FAULT_BELOW");
  if (!below || !getenv("FAULT_READ")) return 0;
  char link[64], path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length < 0) return 0;
  path[length] = 0;
  if (strncmp(path, below, strlen(below)) != 0) return 0;
  return ++calls == number("FAULT_READ");
}

static ssize_t fail_to_read(void) {
  errno = number("FAULT_ERRNO") != 0 ? (int)number("FAULT_ERRNO") : EIO;
  return -1;
}

ssize_t read(int fd, void* data, size_t size) {
  if (read_is_due(fd)) return fail_to_read();
  return ((ssize_t(*)(int, void*, size_t))next("read"))(fd, data, size);
}

static ssize_t read_at(const char* name, int fd, void* data, size_t size, off_t offset) {
  if (read_is_due(fd)) return fail_to_read();
  return ((ssize_t(*)(int, void*, size_t, off_t))next(name))(fd, data, size, offset);
}

ssize_t pread(int fd, void* data, size_t size, off_t offset) {
  return read_at("pread", fd, data, size, offset);
}

ssize_t pread64(int fd, void* data, size_t size, off_t offset) {
  return read_at("pread64", fd, data, size, offset);
}

int clock_gettime(clockid_t clock, struct timespec* now) {
  static time_t back = 0;
  const int code = ((int (*)(clockid_t, struct timespec*))next("clock_gettime"))(clock, now);
  if (code == 0 && clock == CLOCK_REALTIME && getenv("FAULT_CLOCK")) now->tv_sec -= (back += 3600);
  return code;
}

int flock(int fd, int operation) {
  if (number("FAULT_LOCK") != 0) {
    errno = (int)number("FAULT_LOCK");
    return -1;
  }
  return ((int (*)(int, int))next("flock"))(fd, operation);
}
