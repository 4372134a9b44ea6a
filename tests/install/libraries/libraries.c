/* Every installed library, called by its public header: a scene, its stored record and picture, and its oracle. */
#include "golden/golden.h"
#include "oracles/oracle.h"
#include "render/render.h"
#include "solver/record.h"
#include "solver/run.h"
#include "solver/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void need(bool fine, const char *what, const char *why)
{
    if (!fine) {
        (void)fprintf(stderr, "%s: %s\n", what, why);
        exit(1);
    }
}

int main(int count, char **words)
{
    char path[4096];
    struct solver_error error = {.text = ""};
    struct solver_scene *scene = NULL;
    struct solver_record *record = NULL;
    struct golden_report report;
    struct render_image *picture = NULL;
    struct render_difference difference;
    char why[RENDER_WHY] = "it shows something else";
    need(count == 2, "usage", "libraries SHARE");
    (void)snprintf(path, sizeof path, "%s/scenes/elastic-cable.lua", words[1]);
    need(solver_scene_load(path, NULL, 0, &scene, &error), "scene", error.text);
    (void)snprintf(path, sizeof path, "%s/golden/elastic-cable.vtkhdf", words[1]);
    need(solver_record_read(path, &record, &error), "record", error.text);
    need(golden_compare(record, record, &report, &error) && report.pass, "comparison with itself", error.text);
    need(strcmp(record->scene_name, scene->name) == 0, "the record's scene", record->scene_name);
    (void)snprintf(path, sizeof path, "%s/golden/elastic-cable.png", words[1]);
    need(render_png_read(path, &picture, why) && render_compare(picture, picture, false, &difference, why) &&
             difference.same,
         "picture", why);
    need(oracle_find("cable") != NULL, "oracle", "there is no cable");
    (void)printf("%s: %zu fields are as stored\n", scene->title, report.count);
    golden_report_free(&report);
    render_image_free(picture);
    solver_record_free(record);
    solver_scene_free(scene);
    return 0;
}
