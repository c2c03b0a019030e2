/* As much of Fluent's udf.h as a wall condition of the discrete phase needs (Fluent 6.3 UDF Manual,
   section 2.5.1). */
#ifndef UDF_H
#define UDF_H

typedef double real;
typedef struct { int id; } Thread;
typedef int face_t;
typedef struct { real V[3]; real diam; } particle_state_t;
typedef struct { particle_state_t state, state0; } Tracked_Particle;
enum { PATH_ABORT = -1, PATH_END = 0, PATH_ACTIVE = 1 };

#define P_VEL(p) ((p)->state.V)
#define P_VEL0(p) ((p)->state0.V)
#define P_DIAM(p) ((p)->state.diam)
#define DEFINE_DPM_BC(name, p, t, f, f_normal, dim) \
  int name(Tracked_Particle *p, Thread *t, face_t f, real f_normal[], int dim)

#endif
