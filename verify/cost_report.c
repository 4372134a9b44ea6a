/* The cost of a scene, as people and programs read it. */
#include "verify/cost.h"
#include "verify/json.h"
#include "verify/signals.h"
#include "verify/study.h"

#include <math.h>

static const char *const evolved[] = {"{p,F}", "{p,F,J}", "{p,F,H,J}"};

static double per_particle(const struct verify_cost_case *of, double whole)
{
    return whole / (double)of->facts.particles;
}

static double per_step(const struct verify_cost_case *of, const struct solver_cost_term *term)
{
    return per_particle(of, term->flops) * (term->once ? 1.0 : of->stages);
}

static int loops(const struct verify_cost_case *of)
{
    int most = 0;
    for (size_t i = 0; i < of->terms.count; i++) {
        most = of->terms.term[i].loop > most ? of->terms.term[i].loop : most;
    }
    return most;
}

static void print_scene(const struct verify_cost *cost)
{
    const struct solver_scene *scene = cost->scene;
    const struct verify_cost_case *whole = &cost->whole;
    double particles = (double)whole->facts.particles;
    (void)printf("%s (%s)\n  scheme %s", scene->title, scene->path, scene->scheme);
    if (verify_has_stencil(scene)) {
        (void)printf(", stencil %s, %s", scene->stencil, evolved[scene->evolved]);
    }
    (void)printf(", material %s, %dD, %s\n  %zu particles, %.1f neighbours each, %d thread%s; a step has %d right-hand "
                 "sides of %d loops over pairs each\n",
                 scene->material_model, scene->dim, scene->integrator, whole->facts.particles,
                 (double)whole->facts.pairs / particles, whole->facts.threads, whole->facts.threads == 1 ? "" : "s",
                 whole->stages, loops(whole));
}

static void print_arrays(const struct verify_cost_case *of)
{
    (void)printf("\n%-36s %14s\n", "memory", "B/particle");
    for (size_t i = 0; i < of->arrays.count; i++) {
        const struct solver_cost_array *array = &of->arrays.array[i];
        (void)printf("  %-10s %-23s %14.2f\n", array->group, array->name, per_particle(of, (double)array->bytes));
    }
    (void)printf("  %-34s %14.2f  %.3f MB in all\n", "all that is allocated", of->bytes,
                 1e-6 * of->bytes * (double)of->facts.particles);
}

static void print_terms(const struct verify_cost_case *of)
{
    (void)printf("\n%-36s %14s\n", "operations", "flop/p-step");
    for (size_t i = 0; i < of->terms.count; i++) {
        const struct solver_cost_term *term = &of->terms.term[i];
        (void)printf("  %-34s %14.1f", term->name, per_step(of, term));
        if (term->loop > 0) {
            (void)printf("  loop %d over pairs\n", term->loop);
        } else {
            (void)printf("  particles%s\n", term->once ? ", in all of the step" : "");
        }
    }
    (void)printf("  %-34s %14.1f\n", "all", of->flops);
    (void)printf(
        "\nA particle's step takes %.1f ns, %.2f flop/ns; it moves %.0f B if every array streams once per sweep, "
        "%.2f B/ns.\n",
        1e9 * of->seconds, 1e-9 * of->flops / of->seconds, of->facts.step_traffic,
        1e-9 * of->facts.step_traffic / of->seconds);
}

/* Part of the whole that is saved [%]. */
static double saved(double whole, double without)
{
    return 100.0 * (1.0 - without / whole);
}

static void print_items(const struct verify_cost *cost)
{
    const struct verify_cost_case *whole = &cost->whole;
    (void)printf("\n%-22s %13s %7s %12s %7s %12s %7s  %s\n", "without", "flop/p-step", "saved", "B/particle", "saved",
                 "ns/p-step", "saved", "--set");
    for (size_t i = 0; i < cost->item_count; i++) {
        const struct verify_cost_item *item = &cost->item[i];
        const struct verify_cost_case *of = &item->without;
        const char *words = item->words != NULL ? item->words : "(a scene without material.at)";
        if (!of->runs) {
            (void)printf("  %-20s does not run: %s\n", item->name, of->why.text);
            continue;
        }
        (void)printf("  %-20s %13.1f %5.1f %% %12.1f %5.1f %% %12.1f %5.1f %%  %.60s\n", item->name, of->flops,
                     saved(whole->flops, of->flops), of->bytes, saved(whole->bytes, of->bytes), 1e9 * of->seconds,
                     saved(item->beside, of->seconds), words);
    }
    double particles = (double)whole->facts.particles;
    (void)printf("  recorded history: %.0f rows of %.0f B over %.0f steps are %.2f B/particle", cost->rows,
                 cost->row_bytes, cost->steps, cost->rows * cost->row_bytes / particles);
    if (isfinite(cost->row_seconds)) {
        (void)printf("; a row takes %.1f ns/particle, the rows %.2f ns/p-step", 1e9 * cost->row_seconds / particles,
                     1e9 * cost->row_seconds * cost->rows / cost->steps / particles);
    }
    (void)printf("  history=%d\n", cost->scene->history);
}

void verify_cost_print(const struct verify_cost *cost)
{
    print_scene(cost);
    print_arrays(&cost->whole);
    print_terms(&cost->whole);
    print_items(cost);
    if (cost->stopped != 0) {
        (void)printf("\nStopped by %s: other items and the time of a row were not measured.\n",
                     verify_signals_name(cost->stopped));
    }
    (void)printf(
        "\nOperations and bytes are declared, times measured: the best of a few samples. An operation on a padded "
        "vector\ncounts its lanes, a function such as log 20.\n");
}

static void put_case(FILE *file, const struct verify_cost_case *of)
{
    verify_json_number_member(file, "flop_per_particle_step", of->flops);
    (void)fputs(", ", file);
    verify_json_number_member(file, "bytes_per_particle", of->bytes);
    (void)fputs(", ", file);
    verify_json_number_member(file, "ns_per_particle_step", 1e9 * of->seconds);
}

static void put_arrays(FILE *file, const struct verify_cost_case *of)
{
    (void)fputs(",\n  \"arrays\": [", file);
    for (size_t i = 0; i < of->arrays.count; i++) {
        const struct solver_cost_array *array = &of->arrays.array[i];
        (void)fputs(i == 0 ? "\n    {" : ",\n    {", file);
        verify_json_text_member(file, "group", array->group);
        (void)fputs(", ", file);
        verify_json_text_member(file, "name", array->name);
        (void)fprintf(file, ", \"bytes\": %zu}", array->bytes);
    }
    (void)fputs("\n  ],\n  \"terms\": [", file);
    for (size_t i = 0; i < of->terms.count; i++) {
        const struct solver_cost_term *term = &of->terms.term[i];
        (void)fputs(i == 0 ? "\n    {" : ",\n    {", file);
        verify_json_text_member(file, "name", term->name);
        (void)fprintf(file, ", \"pair_loop\": %d, ", term->loop);
        verify_json_number_member(file, "flop_per_particle_step", per_step(of, term));
        (void)fputc('}', file);
    }
    (void)fputs("\n  ]", file);
}

bool verify_cost_json(FILE *file, const void *context, struct solver_error *error)
{
    const struct verify_cost *cost = context;
    const struct verify_cost_case *whole = &cost->whole;
    (void)error;
    (void)fputs("{\n  ", file);
    verify_json_text_member(file, "scene", cost->scene->name);
    (void)fputs(",\n  ", file);
    verify_json_text_member(file, "scheme", cost->scene->scheme);
    if (cost->stopped != 0) {
        (void)fputs(", ", file);
        verify_json_text_member(file, "stopped_by", verify_signals_name(cost->stopped));
    } else {
        (void)fputs(", \"stopped_by\": null", file);
    }
    (void)fprintf(file,
                  ",\n  \"particles\": %zu, \"pairs\": %zu, \"threads\": %d, \"right_hand_sides_per_step\": %d, "
                  "\"pair_loops\": %d,\n  ",
                  whole->facts.particles, whole->facts.pairs, whole->facts.threads, whole->stages, loops(whole));
    put_case(file, whole);
    (void)fputs(", ", file);
    verify_json_number_member(file, "bytes_moved_per_particle_step", whole->facts.step_traffic);
    put_arrays(file, whole);
    (void)fputs(",\n  \"without\": [", file);
    for (size_t i = 0; i < cost->item_count; i++) {
        const struct verify_cost_item *item = &cost->item[i];
        (void)fputs(i == 0 ? "\n    {" : ",\n    {", file);
        verify_json_text_member(file, "name", item->name);
        (void)fprintf(file, ", \"runs\": %s, ", item->without.runs ? "true" : "false");
        put_case(file, &item->without);
        (void)fputs(", ", file);
        verify_json_number_member(file, "ns_per_particle_step_beside", 1e9 * item->beside);
        (void)fputc('}', file);
    }
    (void)fputs("\n  ],\n  \"history\": {", file);
    verify_json_number_member(file, "rows", cost->rows);
    (void)fputs(", ", file);
    verify_json_number_member(file, "bytes_per_row", cost->row_bytes);
    (void)fputs(", ", file);
    verify_json_number_member(file, "ns_per_row", 1e9 * cost->row_seconds);
    (void)fputs("}\n}\n", file);
    return true;
}
