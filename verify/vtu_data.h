/* The numbers of a VTK XML file: as text, or as bytes, base64 or raw, packed by zlib or not. */
#ifndef VERIFY_VTU_DATA_H
#define VERIFY_VTU_DATA_H

#include <stdbool.h>
#include <stddef.h>

/* How the file as a whole stores bytes. */
struct vtu_storage {
    bool big_endian;   /* byte_order */
    bool wide_headers; /* header_type: UInt64 in place of UInt32 */
    bool zlib;         /* compressor */
};

/* One array's text or bytes. */
struct vtu_source {
    enum { VTU_ASCII, VTU_BASE64, VTU_RAW } encoding;
    const char *bytes;
    size_t size; /* up to the end of what may be read */
};

enum { VTU_WHY = 256 };

/* Decodes `count` numbers of `type` into `value`. False, with `why` filled in, if the source does not hold exactly so
 * many. `count` may be anything: memory is asked for only once the source is known to be large enough. */
bool vtu_numbers(const struct vtu_storage *storage, const struct vtu_source *source, const char *type, size_t count,
                 double **value, char why[VTU_WHY]);

#endif
