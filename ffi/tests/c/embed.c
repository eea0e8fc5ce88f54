/* Asks a scene for the light in it, as a program in C does it. Compiled and run by program.rs, which knows the
 * answers. */

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "halflight.h"

/* Memory at an address that halflight can use, never given back: the program is short. */
static void *aligned(size_t bytes) {
    char *memory = malloc(bytes + HALFLIGHT_ALIGNMENT);
    if (memory == NULL) exit(3);
    return memory + (HALFLIGHT_ALIGNMENT - (uintptr_t)memory % HALFLIGHT_ALIGNMENT);
}

static void check(HalflightStatus status) {
    if (status != HALFLIGHT_STATUS_OK) {
        fprintf(stderr, "%s\n", halflight_message((uint32_t)status));
        exit(1);
    }
}

static void print(const char *name, const float numbers[3]) {
    printf("%s %.9g %.9g %.9g\n", name, (double)numbers[0], (double)numbers[1], (double)numbers[2]);
}

/* All bytes of a file. */
static uint8_t *contents(const char *path, size_t *length) {
    FILE *file = fopen(path, "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) exit(3);
    *length = (size_t)ftell(file);
    rewind(file);
    uint8_t *bytes = aligned(*length);
    if (fread(bytes, 1, *length, file) != *length) exit(3);
    fclose(file);
    return bytes;
}

int main(int count, char **arguments) {
    if (count != 2) return 2;
    size_t length, room;
    const uint8_t *bytes = contents(arguments[1], &length);

    const HalflightScene *scene;
    check(halflight_scene_room(bytes, length, &room));
    check(halflight_scene_open(bytes, length, aligned(room), room, &scene));

    HalflightFacts facts;
    check(halflight_scene_facts(scene, &facts));
    printf("facts %u %u %u %u\n", facts.width, facts.height, facts.lights, facts.surfaces);

    const float point[3] = {0.1f, 0.001f, 0.2f}, up[3] = {0.0f, 2.0f, 0.0f};
    HalflightIrradiance light;
    check(halflight_irradiance(scene, point, up, 256, 7, &light));
    print("irradiance", light.mean);
    print("error", light.standard_error);
    print("unshadowed", light.unshadowed);
    printf("closed %d\n", (int)light.has_closed_form);

    float seen;
    check(halflight_visibility(scene, point, up, 0, 256, 7, &seen));
    printf("visibility %.9g\n", (double)seen);

    const float eye[3] = {0.278f, 0.273f, -0.8f}, forward[3] = {0.0f, -0.1f, 1.0f};
    HalflightRadiance radiance;
    check(halflight_ray(scene, eye, forward, 64, 7, &radiance));
    print("ray", radiance.mean);
    check(halflight_pixel(scene, 3, 5, 16, 7, &radiance));
    print("pixel", radiance.mean);

    if (halflight_pixel(scene, facts.width, 0, 16, 7, &radiance) != HALFLIGHT_STATUS_ARGUMENT) return 4;
    if (halflight_ray(NULL, eye, forward, 64, 7, &radiance) != HALFLIGHT_STATUS_NULL) return 4;
    return 0;
}
