/* SPDX-License-Identifier: MIT */
/* A compiled model: the kernels of a generated header in a shared object, behind a C interface. `lagen compile MODEL -o
 * FILE.so` makes one; lagen itself, Python and simulators load it and look up the one symbol
 *     const lagen_compiled_model* lagen_compiled_model_of(void);
 * Numbers are doubles, angles radians, units those of the model. A state is `dimension` numbers: base coordinates, then
 * the others. Arrays that a kernel reads or writes begin at multiples of 16 bytes, as malloc's do. Kernels take no
 * memory and lock nothing; they answer a number of lagen::Status (lagen/status.hpp), 0 where all is well. A pointer to
 * a function that the model does not have is 0.
 *
 * An instance holds the parameters, the inputs and what a search begins with: `instance_size` bytes that begin at a
 * multiple of 64 and may be copied byte by byte. */
#ifndef LAGEN_COMPILED_MODEL_H
#define LAGEN_COMPILED_MODEL_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Every change of this file is another version. */
#define LAGEN_COMPILED_MODEL_VERSION UINT32_C(1)

/* The instructions beyond the base of its processor that a compiler may use now; the object has it as the symbol
 *     const char lagen_compiled_model_machine[];
 * so that it is known before the first of them is met. */
#if defined(__AVX512F__)
#define LAGEN_COMPILED_MODEL_MACHINE "avx512f"
#elif defined(__AVX2__)
#define LAGEN_COMPILED_MODEL_MACHINE "avx2"
#elif defined(__AVX__)
#define LAGEN_COMPILED_MODEL_MACHINE "avx"
#elif defined(__SSE4_2__)
#define LAGEN_COMPILED_MODEL_MACHINE "sse4.2"
#else
#define LAGEN_COMPILED_MODEL_MACHINE "base"
#endif

/* A function of time and state with `rows` x `columns` values, stored column by column; `names`
 * of its rows, of `jumps` those of its columns, or 0. */
typedef struct lagen_values {
    const char* name; /* of the kernel: "energy", "observables", "events", "jumps", .. */
    int32_t rows;
    int32_t columns;
    const char* const* names;
    void (*evaluate)(const void* instance, double t, const double* s, double* values);
} lagen_values;

/* Numbers of an instance that may be set: parameters, or inputs. */
typedef struct lagen_numbers {
    int32_t count;
    const char* const* names;
    double* (*entry)(void* instance, int32_t index);
} lagen_numbers;

/* Taylor coefficients along the motion up to `order` <= highest_order, in powers of t/unit (a unit other than 1 where
 * has_unit alone): x[k * dimension + i] is that of order k of lane i; of functions e[k * count + r]. */
typedef struct lagen_series {
    int32_t highest_order;
    int32_t has_unit;
    int32_t sums; /* Cauchy products a series */
    int32_t (*motion)(const void* instance, double t, const double* s, int32_t order, double unit, double* x);
    int32_t (*events)(const void* instance, double t, const double* s, int32_t order, double unit, const double* x,
                      double* e);
    int32_t (*domain)(const void* instance, double t, const double* s, int32_t order, double unit, const double* x,
                      double* e);
} lagen_series;

/* The entries of the Jacobian d(ds)/ds that are not zero by structure, by rows. */
typedef struct lagen_jacobian {
    int32_t count;
    const int32_t* rows;
    const int32_t* columns;
    void (*values)(const void* instance, double t, const double* s, double* entries);
} lagen_jacobian;

typedef struct lagen_compiled_model {
    uint32_t version; /* LAGEN_COMPILED_MODEL_VERSION; the first member of every version */
    uint32_t size;    /* bytes of this struct */
    const char* name;
    const char* hash; /* of the model */
    int32_t dimension;
    int32_t base_dimension;
    int32_t second_order; /* 1: x' = v and v' = f(t, x, v); 2: v' = f(t, x); 0: neither is known */
    const char* const* state_names;

    size_t instance_size;
    void (*construct)(void* instance); /* with the defaults of the model */
    lagen_numbers parameters, inputs;
    int32_t (*parameter_status)(const void* instance);

    int32_t (*rhs)(const void* instance, double t, const double* s, double* ds); /* s and ds may be the same */
    /* The same of 4 or 8 states at once: number l of lane i is s[width * i + l]; a status each. */
    void (*rhs4)(const void* instance, const double* t, const double* s, double* ds, uint8_t* status);
    void (*rhs8)(const void* instance, const double* t, const double* s, double* ds, uint8_t* status);
    int32_t (*follow)(void* instance, double t, const double* s); /* what is searched for, from where it was found */
    void (*stay_on_groups)(const void* instance, const double* s0, double* s1);
    lagen_jacobian jacobian;
    lagen_series series;

    int32_t functions;
    const lagen_values* function;
} lagen_compiled_model;

#ifdef __cplusplus
}
#endif

#endif
