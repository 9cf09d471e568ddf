// Asks rays what they meet, without rendering: it draws a hollow ball, cut open, with a ring around
// it in letters on the terminal, then lists every crossing of one ray.
#include <crt/crt.h>
#include <math.h>
#include <stdio.h>

enum { columns = 72, rows = 28, ray_count = columns * rows };

// A letter is what the program knows of one character. CRT reads the rays and writes the hits in
// place: it gets the number of bytes from one letter to the next.
typedef struct letter {
  crt_ray view;
  crt_full_hit hit;
  crt_ray to_light;
  int row, column;
} letter;

static const double right[3] = {2 / 3.0, -2 / 3.0, 1 / 3.0}, up[3] = {1 / 3.0, 2 / 3.0, 2 / 3.0};
static const double forward[3] = {-2 / 3.0, -1 / 3.0, 2 / 3.0},
                    light[3] = {3 / 7.0, 6 / 7.0, -2 / 7.0};

static int make_scene(crt_prepared** out) {
  const double middle[3] = {0, 0, 0}, axis[3] = {0, 1, 0}, near[3] = {0.1, 0.1, -2},
               far[3] = {2, 2, -0.1};
  crt_entity *ball = NULL, *cutters[2] = {NULL, NULL}, *shell = NULL, *ring = NULL,
             *numbered = NULL;
  crt_scene* scene = NULL;
  const int failed =
      crt_sphere_create(middle, 1, &ball) || crt_sphere_create(middle, 0.6, &cutters[0]) ||
      crt_box_create(near, far, &cutters[1]) || crt_difference_create(ball, cutters, 2, &shell) ||
      crt_torus_create(middle, axis, 1.5, 0.12, &ring) || crt_entity_with_id(ring, 7, &numbered) ||
      crt_scene_create(&scene) || crt_scene_add_entity(scene, shell) ||
      crt_scene_add_entity(scene, numbered) || crt_scene_prepare(scene, out);
  crt_scene_release(scene);
  crt_entity_release(numbered);
  crt_entity_release(ring);
  crt_entity_release(shell);
  crt_entity_release(cutters[1]);
  crt_entity_release(cutters[0]);
  crt_entity_release(ball);
  return failed;
}

// Makes parallel rays, where a letter is twice as high as it is wide.
static void aim(letter* letters) {
  const double width = 3.6, letter_width = width / columns;
  for (int i = 0; i < ray_count; ++i) {
    const int row = i / columns, column = i % columns;
    const double x = (column + 0.5 - columns / 2) * letter_width;
    const double y = (rows / 2 - row - 0.5) * 2 * letter_width;
    letters[i].row = row;
    letters[i].column = column;
    letters[i].view.t_min = 0;
    letters[i].view.t_max = INFINITY;
    for (int k = 0; k < 3; ++k) {
      letters[i].view.origin[k] = x * right[k] + y * up[k] - 10 * forward[k];
      letters[i].view.direction[k] = forward[k];
    }
  }
}

// Makes a ray from each hit to the light. The hit says on which surface that begins.
static void aim_at_light(letter* letters) {
  for (int i = 0; i < ray_count; ++i) {
    const letter* l = &letters[i];
    letters[i].to_light.t_min = 0;
    letters[i].to_light.t_max = INFINITY;
    for (int k = 0; k < 3; ++k) {
      letters[i].to_light.origin[k] = l->hit.position[k];
      letters[i].to_light.direction[k] = light[k];
    }
  }
}

static void draw(const letter* letters, const uint8_t* shadowed) {
  static const char shades[] = ".:-=+*#%@";
  for (int i = 0; i < ray_count; ++i) {
    const double* n = letters[i].hit.normal;
    const double slant = n[0] * light[0] + n[1] * light[1] + n[2] * light[2];
    const double brightness = shadowed[i] || slant < 0 ? 0 : slant;
    putchar(letters[i].hit.t < INFINITY ? shades[(int)(brightness * (sizeof shades - 2) + 0.5)]
                                        : ' ');
    if (letters[i].column == columns - 1) putchar('\n');
  }
}

static int list_crossings(crt_prepared* prepared) {
  const crt_ray ray = {{-5, 0, 0}, {1, 0, 0}, 0, INFINITY};
  crt_hit hits[16];
  size_t count = 0;
  if (crt_crossings(prepared, &ray, hits, 16, &count)) return 1;
  printf("\nFrom (-5, 0, 0) along x there are %u crossings:\n", (unsigned)count);
  for (size_t i = 0; i < count && i < 16; ++i) {
    printf("  t = %.2f  %s entity %u\n", hits[i].t,
           hits[i].flags & CRT_HIT_ENTERING ? "into  " : "out of", (unsigned)hits[i].entity_id);
  }
  return 0;
}

int main(void) {
  static letter letters[ray_count];
  static uint8_t shadowed[ray_count];
  crt_prepared* prepared = NULL;
  aim(letters);
  int failed = make_scene(&prepared) || crt_trace(prepared, &letters->view, sizeof *letters, NULL,
                                                  0, ray_count, &letters->hit, sizeof *letters);
  if (!failed) {
    aim_at_light(letters);
    failed = crt_blocked(prepared, &letters->to_light, sizeof *letters, &letters->hit.start, NULL,
                         sizeof *letters, ray_count, shadowed);
  }
  if (!failed) {
    draw(letters, shadowed);
    failed = list_crossings(prepared);
  }
  if (failed) fprintf(stderr, "queries: %s\n", crt_error_message());
  crt_prepared_release(prepared);
  return failed;
}
