// What the C library of a page lacks.

#include <pthread.h>

/// There is one thread, whose stack the link fixes.
extern "C" int pthread_setattr_default_np(const pthread_attr_t*) { return 0; }
