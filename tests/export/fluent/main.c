/* main DIAMETER VELOCITY: one sphere against a wall that is oblique to the axes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "recoil_rebound.c"

int main(int argc, char **argv)
{
  real normal[3] = {0.6, 0.0, 0.8};
  real slip[3] = {0.8, 0.0, -0.6};
  Tracked_Particle p;
  Thread wall = {1};
  int i, status;
  real back = 0.0, along = 0.0, velocity;
  if (argc != 3) return 2;
  p.state.diam = atof(argv[1]);
  velocity = atof(argv[2]);
  for (i = 0; i < 3; i++) p.state.V[i] = velocity * normal[i] + 3.0 * slip[i];
  p.state0 = p.state;
  status = recoil_rebound(&p, &wall, 0, normal, 3);
  for (i = 0; i < 3; i++) {
    back -= p.state.V[i] * normal[i];
    along += p.state.V[i] * slip[i];
  }
  printf("restitution %.12f\n", back / velocity);
  printf("tangential %.12f status %d\n", along, status);
  return 0;
}
