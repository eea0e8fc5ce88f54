/* halflight from C. Written by cbindgen from ffi/src: do not edit. */

#ifndef HALFLIGHT_H
#define HALFLIGHT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/**
 * What divides the addresses of a scene's bytes and of the memory for it.
 */
#define HALFLIGHT_ALIGNMENT 16

/**
 * What became of a call. Where it is not `OK`, there is no answer.
 */
typedef enum HalflightStatus {
  /**
   * All is well.
   */
  HALFLIGHT_STATUS_OK = 0,
  /**
   * A pointer is null.
   */
  HALFLIGHT_STATUS_NULL = 1,
  /**
   * Bytes or memory are not at an address that `HALFLIGHT_ALIGNMENT` divides, or another pointer is not at
   * one that is right for its type.
   */
  HALFLIGHT_STATUS_MISALIGNED = 2,
  /**
   * The bytes are no scene, or one of another version.
   */
  HALFLIGHT_STATUS_NOT_A_SCENE = 3,
  /**
   * The bytes were changed or cut.
   */
  HALFLIGHT_STATUS_DAMAGED = 4,
  /**
   * An entry of the scene is none that halflight accepts.
   */
  HALFLIGHT_STATUS_REFUSED = 5,
  /**
   * There is less memory than `halflight_scene_room` says.
   */
  HALFLIGHT_STATUS_ROOM = 6,
  /**
   * A number is out of its range.
   */
  HALFLIGHT_STATUS_ARGUMENT = 7,
  /**
   * Nothing of that light arrives there in any case, or there is no such light.
   */
  HALFLIGHT_STATUS_NO_LIGHT = 8,
} HalflightStatus;

/**
 * An open scene, in memory of the caller. It is read only: any number of threads may ask it.
 */
typedef struct HalflightScene HalflightScene;

/**
 * What a scene holds.
 */
typedef struct HalflightFacts {
  /**
   * Columns of its picture.
   */
  uint32_t width;
  /**
   * Rows of its picture.
   */
  uint32_t height;
  /**
   * Lights.
   */
  uint32_t lights;
  /**
   * Surfaces.
   */
  uint32_t surfaces;
} HalflightFacts;

/**
 * The light at a point, each of red, green and blue.
 */
typedef struct HalflightIrradiance {
  /**
   * Irradiance, shadows included (W m⁻²).
   */
  float mean[3];
  /**
   * Its standard error, as if the samples were independent: the true one is smaller (W m⁻²).
   */
  float standard_error[3];
  /**
   * The irradiance if nothing were in the way, in closed form (W m⁻²); 0 where there is none.
   */
  float unshadowed[3];
  /**
   * Whether all lights have a closed form.
   */
  bool has_closed_form;
} HalflightIrradiance;

/**
 * What arrives from a direction, each of red, green and blue.
 */
typedef struct HalflightRadiance {
  /**
   * Radiance (W m⁻² sr⁻¹).
   */
  float mean[3];
  /**
   * Its standard error, as if the samples were independent: the true one is smaller (W m⁻² sr⁻¹).
   */
  float standard_error[3];
} HalflightRadiance;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Says how much memory a scene takes beside its bytes.
 *
 * * `bytes`, `length` – of a scene as `halflight export SCENE --as bytes` writes it
 * * `room` – receives the number of bytes
 *
 * # Safety
 * `bytes` must be null or point to `length` bytes, `room` must be null or point to a `size_t`.
 */
enum HalflightStatus halflight_scene_room(const uint8_t *bytes, size_t length, size_t *room);

/**
 * Checks a scene and opens it: once, before it is asked. There is nothing to close.
 *
 * * `bytes`, `length` – as for `halflight_scene_room`; must stay as they are while the scene is used
 * * `memory`, `room` – as much as `halflight_scene_room` says, for nothing else while the scene is used
 * * `scene` – receives the open scene
 *
 * # Safety
 * `bytes` must be null or point to `length` bytes, `memory` must be null or point to `room` bytes, `scene`
 * must be null or point to a pointer.
 */
enum HalflightStatus halflight_scene_open(const uint8_t *bytes,
                                          size_t length,
                                          void *memory,
                                          size_t room,
                                          const struct HalflightScene **scene);

/**
 * Says what a scene holds.
 *
 * * `scene` – from `halflight_scene_open`
 * * `facts` – receives the answer
 *
 * # Safety
 * `scene` must be null or open, `facts` must be null or point to a `HalflightFacts`.
 */
enum HalflightStatus halflight_scene_facts(const struct HalflightScene *scene,
                                           struct HalflightFacts *facts);

/**
 * Irradiance at a point from the side that its normal is on.
 *
 * * `scene` – from `halflight_scene_open`
 * * `point` – x, y and z (m), in free space
 * * `normal` – x, y and z, of any length
 * * `samples` – of each light, 1 or more; powers of two serve best
 * * `seed` – which random numbers
 * * `irradiance` – receives the answer
 *
 * # Safety
 * `scene` must be null or open, `point` and `normal` null or point to three numbers, `irradiance` must be
 * null or point to a `HalflightIrradiance`.
 */
enum HalflightStatus halflight_irradiance(const struct HalflightScene *scene,
                                          const float *point,
                                          const float *normal,
                                          uint32_t samples,
                                          uint32_t seed,
                                          struct HalflightIrradiance *irradiance);

/**
 * How much of a light is seen from a point: 0 in the umbra, 1 in full light, between them in the penumbra.
 *
 * * `scene` – from `halflight_scene_open`
 * * `point`, `normal`, `samples`, `seed` – as for `halflight_irradiance`
 * * `light` – its index
 * * `visibility` – receives the answer
 *
 * # Safety
 * `scene` must be null or open, `point` and `normal` null or point to three numbers, `visibility` must be
 * null or point to a `float`.
 */
enum HalflightStatus halflight_visibility(const struct HalflightScene *scene,
                                          const float *point,
                                          const float *normal,
                                          uint32_t light,
                                          uint32_t samples,
                                          uint32_t seed,
                                          float *visibility);

/**
 * What arrives along a ray: direct light from the surface that it meets.
 *
 * * `scene` – from `halflight_scene_open`
 * * `origin` – x, y and z of the eye (m)
 * * `toward` – x, y and z of the direction, of any length
 * * `samples`, `seed` – as for `halflight_irradiance`
 * * `radiance` – receives the answer
 *
 * # Safety
 * `scene` must be null or open, `origin` and `toward` null or point to three numbers, `radiance` must be
 * null or point to a `HalflightRadiance`.
 */
enum HalflightStatus halflight_ray(const struct HalflightScene *scene,
                                   const float *origin,
                                   const float *toward,
                                   uint32_t samples,
                                   uint32_t seed,
                                   struct HalflightRadiance *radiance);

/**
 * A pixel of the scene's picture: the bits of `halflight render --technique auto --choose all --sequence
 * sobol` with as many samples and the same seed.
 *
 * * `scene` – from `halflight_scene_open`
 * * `column`, `row` – from the left, from the top
 * * `samples`, `seed` – as for `halflight_irradiance`
 * * `radiance` – receives the answer
 *
 * # Safety
 * `scene` must be null or open, `radiance` must be null or point to a `HalflightRadiance`.
 */
enum HalflightStatus halflight_pixel(const struct HalflightScene *scene,
                                     uint32_t column,
                                     uint32_t row,
                                     uint32_t samples,
                                     uint32_t seed,
                                     struct HalflightRadiance *radiance);

/**
 * What a status means, in words: a text of static duration, never null.
 *
 * * `status` – a `HalflightStatus`, or any other number
 */
const char *halflight_message(uint32_t status);

/**
 * What a status means, in words: a text of static duration, never null.
 *
 * * `status` – a `HalflightStatus`, or any other number
 */
const char *halflight_message(uint32_t status);

/**
 * Irradiance at a point from the side that its normal is on.
 *
 * * `scene` – from `halflight_scene_open`
 * * `point` – x, y and z (m), in free space
 * * `normal` – x, y and z, of any length
 * * `samples` – of each light, 1 or more; powers of two serve best
 * * `seed` – which random numbers
 * * `irradiance` – receives the answer
 *
 * # Safety
 * `scene` must be null or open, `point` and `normal` null or point to three numbers, `irradiance` must be
 * null or point to a `HalflightIrradiance`.
 */
enum HalflightStatus halflight_irradiance(const struct HalflightScene *scene,
                                          const float *point,
                                          const float *normal,
                                          uint32_t samples,
                                          uint32_t seed,
                                          struct HalflightIrradiance *irradiance);

/**
 * How much of a light is seen from a point: 0 in the umbra, 1 in full light, between them in the penumbra.
 *
 * * `scene` – from `halflight_scene_open`
 * * `point`, `normal`, `samples`, `seed` – as for `halflight_irradiance`
 * * `light` – its index
 * * `visibility` – receives the answer
 *
 * # Safety
 * `scene` must be null or open, `point` and `normal` null or point to three numbers, `visibility` must be
 * null or point to a `float`.
 */
enum HalflightStatus halflight_visibility(const struct HalflightScene *scene,
                                          const float *point,
                                          const float *normal,
                                          uint32_t light,
                                          uint32_t samples,
                                          uint32_t seed,
                                          float *visibility);

/**
 * What arrives along a ray: direct light from the surface that it meets.
 *
 * * `scene` – from `halflight_scene_open`
 * * `origin` – x, y and z of the eye (m)
 * * `toward` – x, y and z of the direction, of any length
 * * `samples`, `seed` – as for `halflight_irradiance`
 * * `radiance` – receives the answer
 *
 * # Safety
 * `scene` must be null or open, `origin` and `toward` null or point to three numbers, `radiance` must be
 * null or point to a `HalflightRadiance`.
 */
enum HalflightStatus halflight_ray(const struct HalflightScene *scene,
                                   const float *origin,
                                   const float *toward,
                                   uint32_t samples,
                                   uint32_t seed,
                                   struct HalflightRadiance *radiance);

/**
 * A pixel of the scene's picture: the bits of `halflight render --technique auto --choose all --sequence
 * sobol` with as many samples and the same seed.
 *
 * * `scene` – from `halflight_scene_open`
 * * `column`, `row` – from the left, from the top
 * * `samples`, `seed` – as for `halflight_irradiance`
 * * `radiance` – receives the answer
 *
 * # Safety
 * `scene` must be null or open, `radiance` must be null or point to a `HalflightRadiance`.
 */
enum HalflightStatus halflight_pixel(const struct HalflightScene *scene,
                                     uint32_t column,
                                     uint32_t row,
                                     uint32_t samples,
                                     uint32_t seed,
                                     struct HalflightRadiance *radiance);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* HALFLIGHT_H */
