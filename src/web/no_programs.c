// A page starts no other programs.
#include <errno.h>
#include <spawn.h>

int posix_spawnp(pid_t *child, const char *program, const posix_spawn_file_actions_t *actions,
                 const posix_spawnattr_t *attributes, char *const arguments[], char *const environment[]) {
  (void)child, (void)program, (void)actions, (void)attributes, (void)arguments, (void)environment;
  return ENOENT;
}
