/* Checks the layout of each struct. The tests of the library check the same rows. */
#include "../include/ads_cnc.h"

#include <stddef.h>

#ifdef __cplusplus
#define CHECK(what, text) static_assert(what, text)
#else
#define CHECK(what, text) _Static_assert(what, text)
#endif

#define PICK(of64, of32) (sizeof(void *) == 8 ? (of64) : (of32))
#define SIZE(type, of64, of32) CHECK(sizeof(type) == PICK(of64, of32), "size of " #type);
#define FIELD(type, field, of64, of32)                                                                     \
    CHECK(offsetof(type, field) == PICK(of64, of32), "offset of " #type "." #field);
#include "layout.h"

int main(void) { return ads_cnc_abi() == ADS_CNC_ABI ? 0 : 1; }
