/*
 * ads-cnc: the byte streams with which an ISG/TwinCAT CNC is read and written over ADS, for C11, C++17 and
 * whatever calls C. MIT or Apache-2.0, at your option.
 *
 *   A client  fills an AdsCncRequest        ads_cnc_encode        sends the AdsCncCall over its ADS library
 *             and reads what comes back     ads_cnc_decode_reply  a list of fields
 *   A server  gets an AdsCncCall            ads_cnc_dispatch      an AdsCncRequest
 *             and answers                   ads_cnc_build         the bytes of a reply, from its fields
 *
 * Memory. The library has none: no allocator, no globals, nothing to free. All memory is the caller's, and
 * what points into a buffer is valid as long as the buffer is unchanged. Any thread may call any function;
 * two threads must not use the same memory at once. Buffers that are read and written must not overlap.
 *
 * Errors. Functions return true, or false and write an AdsCncError where `error` points to. Any number and
 * any length is safe to pass; a wrong pointer is not. Null is accepted for no bytes, and where a result is
 * not wanted. After an error, the content of output buffers is unspecified.
 *
 * Numbers. Functions, streams and fields have numbers that another version may change: find them by name,
 * once, at the start. ads_cnc_abi() must return ADS_CNC_ABI.
 *
 * Texts. Names in requests and in streams are CP1252, as on the wire; ASCII needs no conversion, UTF-8 is
 * converted by ads_cnc_text_from_utf8 and back by ads_cnc_text_to_utf8. Names and descriptions that this
 * library returns are valid for ever and have no NUL: print them by "%.*s".
 */
#ifndef ADS_CNC_H
#define ADS_CNC_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The ABI that this header describes: the minor version of the library. */
#define ADS_CNC_ABI 1

/* No function, stream or field. */
#define ADS_CNC_NONE 0xFFFFFFFFu

/* The number of the ABI that the library has. */
uint32_t ads_cnc_abi(void);

/* ------------------------------------------------------------------------------------- structs */

/* Bytes of the caller; null with length 0 for none. */
typedef struct AdsCncBytes {
    const uint8_t *data;
    uint32_t length;
} AdsCncBytes;

/* Why a function returned false. To print one:
 *
 *   fprintf(stderr, "%.*s: %.*s at offset %u: %.*s, expected %u, found %u\n",
 *           (int)e.subject.length, (const char *)e.subject.data, (int)e.name.length, ...);
 */
typedef struct AdsCncError {
    uint32_t kind;       /* AdsCncErrorKind */
    uint32_t stream;     /* the stream at fault, or ADS_CNC_NONE */
    uint32_t field;      /* its field at fault, or ADS_CNC_NONE for the whole */
    uint32_t offset;     /* of the field, in bytes from the start of the stream */
    uint32_t expected;   /* a number whose meaning depends on the kind */
    uint32_t found;      /* likewise */
    AdsCncBytes subject; /* name of the stream, or of what else is at fault */
    AdsCncBytes name;    /* name of the field, or of the argument */
    AdsCncBytes text;    /* the kind in words */
} AdsCncError;

typedef enum AdsCncErrorKind {
    /* of a stream or of a value: expected, found */
    ADS_CNC_OTHER_ERROR = 0,
    ADS_CNC_TRUNCATED = 1,     /* bytes the field needs, bytes there */
    ADS_CNC_TRAILING = 2,      /* length of the stream, length given */
    ADS_CNC_TOO_LONG = 3,      /* the limit, the length */
    ADS_CNC_TOO_MANY = 4,      /* the most that fits, the count */
    ADS_CNC_MISSING_NUL = 5,   /* bytes the text may have with its NUL, bytes there */
    ADS_CNC_INNER_NUL = 6,     /* 0, index in the text */
    ADS_CNC_NOT_CP1252 = 7,    /* 0, code point */
    ADS_CNC_NOT_DECIMAL = 8,   /* 0, code point */
    ADS_CNC_DIGITS = 9,        /* the most digits, the digits there */
    ADS_CNC_UNEXPECTED = 10,   /* 0, code point */
    ADS_CNC_MISSING = 11,
    ADS_CNC_OUT_OF_RANGE = 12, /* the nearest value allowed, the value */
    ADS_CNC_MISMATCH = 13,     /* the other value, this value */
    ADS_CNC_CONTENT = 14,      /* 0, an index offset that is a function's, where content is wanted */
    ADS_CNC_BUFFER = 15,       /* bytes needed, bytes there */
    /* of the caller */
    ADS_CNC_POINTER = 32,      /* null where something is needed, or a length that no memory has */
    ADS_CNC_NO_FUNCTION = 33,
    ADS_CNC_NO_STREAM = 34,
    ADS_CNC_NO_FIELD = 35,
    ADS_CNC_ARGUMENT = 36,     /* a value that the function does not take; name is the argument's */
    ADS_CNC_ROOM = 37,         /* items or bytes needed, room given */
    ADS_CNC_NOT_STARTED = 38,  /* a sender or host in memory that was never started */
    ADS_CNC_LINE = 39,         /* line, characters or byte found; offset is the column */
    /* of a received call */
    ADS_CNC_NO_PORT = 40,      /* 0, the port */
    ADS_CNC_NO_GROUP = 41,     /* 0, the index group */
    ADS_CNC_NO_OFFSET = 42,    /* 0, the index offset */
    ADS_CNC_COMMAND = 43       /* the command of the function, the command of the call */
} AdsCncErrorKind;

/* The arguments of any function. Those count that the function takes (ads_cnc_function_info says which);
 * the others must be zero: `AdsCncRequest request = {0};`. */
typedef struct AdsCncRequest {
    uint32_t function;      /* ads_cnc_function */
    uint32_t channel;       /* from 1; for lists of objects and for object addresses also 0, the platform */
    uint32_t by_index;      /* 1: `channel` counts the active ones */
    uint32_t axis;          /* axis of the channel, from 1; for lists, with channel 0, a platform axis */
    uint32_t index;         /* variables from 0; parameters and objects from 1 */
    uint32_t count;         /* descriptors to read */
    uint32_t size;          /* the most bytes of a content to read */
    uint32_t handle;        /* of a variable */
    uint32_t index_group;   /* of an element's content, or of an object */
    uint32_t index_offset;  /* likewise */
    AdsCncBytes kind;       /* "V.E", "V.G", "V.A" or none for all; "P", "V.L", "V.P", "V.S" of parameters;
                               of object addresses the class: "position controller", "interpolator",
                               "decoder", "HLD", "path preparation", "spindle" */
    AdsCncBytes name;       /* CP1252, without a NUL */
    AdsCncBytes value;      /* the bytes to write */
    const uint32_t *indices; /* one for each dimension, from 0 */
    uint32_t indices_count;
} AdsCncRequest;

/* The fields of an AdsCncRequest, as ads_cnc_function_info lists them. */
typedef enum AdsCncArgument {
    ADS_CNC_CHANNEL = 1,
    ADS_CNC_AXIS = 2,
    ADS_CNC_INDEX = 3,
    ADS_CNC_COUNT = 4,
    ADS_CNC_SIZE = 5,
    ADS_CNC_HANDLE = 6,
    ADS_CNC_INDEX_GROUP = 7,
    ADS_CNC_INDEX_OFFSET = 8,
    ADS_CNC_KIND = 9,
    ADS_CNC_NAME = 10,
    ADS_CNC_VALUE = 11,
    ADS_CNC_INDICES = 12
} AdsCncArgument;

/* A call as ADS carries it. */
typedef struct AdsCncCall {
    uint32_t port;         /* AMS port: 551 GEO, 552 SDA, 553 COM */
    uint32_t command;      /* AMS command: 2 Read, 3 Write, 9 ReadWrite */
    uint32_t index_group;
    uint32_t index_offset;
    uint32_t read_length;  /* the most bytes of the reply; 0 for a Write */
    AdsCncBytes data;      /* of the request; none for a Read */
} AdsCncCall;

/* A field of a decoded stream, or one item of a field that is a list. */
typedef struct AdsCncField {
    uint32_t field;   /* its number */
    uint32_t record;  /* which record of a stream of records, from 0 */
    uint32_t item;    /* which item of a list, from 0 */
    uint32_t offset;  /* where its bytes are in the data that was decoded */
    uint32_t length;  /* how many they are; of a text with its NUL and what follows that */
    uint32_t number;  /* the number, if it is one of at most four bytes; else 0 */
} AdsCncField;

/* A field of a stream to write, or one item of a field that is a list. */
typedef struct AdsCncPart {
    uint32_t field;
    uint32_t number;   /* of a field that is a number of at most four bytes, if data.data is null */
    AdsCncBytes data;  /* of any other; of a text with its NUL, if it is to have one */
} AdsCncPart;

/* --------------------------------------------------------------------------------- client */

/* Writes the data of a request to `buffer`; `call` has where to send it. 2048 bytes are room enough for all
 * but contents. */
bool ads_cnc_encode(const AdsCncRequest *request, uint8_t *buffer, uint32_t room, AdsCncCall *call,
                    AdsCncError *error);

/* Checks the data received in reply to a request and gives the place of each field, in the order of the
 * table. `count` is how many there are; with `fields` null they are only counted. A reply to a Write has
 * none. Pass the length that was received, not the length asked for: see the README. */
bool ads_cnc_decode_reply(const AdsCncRequest *request, const uint8_t *data, uint32_t length,
                          AdsCncField *fields, uint32_t room, uint32_t *count, AdsCncError *error);

/* --------------------------------------------------------------------------------- server */

/* The function that a received call is to, with its arguments. Names and values point into the call's data,
 * indices to `indices`, which needs room for 510. On an error, `ads_error` is the ADS error number for the
 * response. The server checks that its reply fits the read length of the call. */
bool ads_cnc_dispatch(const AdsCncCall *call, uint32_t *indices, uint32_t room, AdsCncRequest *request,
                      uint32_t *ads_error, AdsCncError *error);

/* -------------------------------------------------------------------------------- streams */

/* Checks a stream and gives the place of each field, as ads_cnc_decode_reply does. */
bool ads_cnc_decode(uint32_t stream, const uint8_t *data, uint32_t length, AdsCncField *fields, uint32_t room,
                    uint32_t *count, AdsCncError *error);

/* Writes a stream from its fields: in the order of the table, each item of a list a part of its own, each
 * record after the one before. Counts may be left out; they are those of the items. What would not be read
 * as it was meant is an error. */
bool ads_cnc_build(uint32_t stream, const AdsCncPart *parts, uint32_t count, uint8_t *buffer, uint32_t room,
                   uint32_t *length, AdsCncError *error);

/* CP1252 up to its first NUL, or all of it, as UTF-8 without a NUL. `length` is what that needs; without
 * enough room it is set too, and the result is false. */
bool ads_cnc_text_to_utf8(const uint8_t *data, uint32_t size, uint8_t *buffer, uint32_t room,
                          uint32_t *length, AdsCncError *error);

/* UTF-8 as CP1252 without a NUL, likewise. A character that CP1252 does not have is an error; its offset
 * counts characters. */
bool ads_cnc_text_from_utf8(const uint8_t *data, uint32_t size, uint8_t *buffer, uint32_t room,
                            uint32_t *length, AdsCncError *error);

/* --------------------------------------------------------------------------------- tables */

typedef enum AdsCncEffect {
    ADS_CNC_EFFECT_NONE = 0,
    ADS_CNC_EFFECT_WRITE = 1,  /* changes a value */
    ADS_CNC_EFFECT_MOTION = 2  /* may move an axis */
} AdsCncEffect;

typedef struct AdsCncFunctionInfo {
    AdsCncBytes name;         /* in reports: "read variable value by name" */
    AdsCncBytes operation;    /* in programs: "ReadByName" */
    uint32_t port;
    uint32_t command;
    uint32_t effect;          /* AdsCncEffect */
    uint32_t request;         /* stream of the request, or ADS_CNC_NONE */
    uint32_t reply;           /* stream of the reply, or ADS_CNC_NONE */
    uint32_t argument_count;
    uint32_t arguments[8];    /* AdsCncArgument */
} AdsCncFunctionInfo;

typedef struct AdsCncStreamInfo {
    AdsCncBytes name;      /* "variable-description" */
    AdsCncBytes title;     /* in a few words */
    uint32_t max;          /* the most bytes */
    uint32_t field_count;
    uint32_t repeats;      /* 1: one or more records of these fields */
} AdsCncStreamInfo;

typedef enum AdsCncFieldKind {
    ADS_CNC_NUMBER = 1,   /* unsigned, little-endian */
    ADS_CNC_BOOLEAN = 2,  /* one byte; 0 is FALSE */
    ADS_CNC_REAL64 = 3,   /* IEEE 754 binary64, little-endian */
    ADS_CNC_TEXT = 4,     /* CP1252 */
    ADS_CNC_NET_ID = 5,   /* six bytes */
    ADS_CNC_BYTES = 6
} AdsCncFieldKind;

typedef struct AdsCncFieldInfo {
    AdsCncBytes name;
    AdsCncBytes meaning;  /* in a few words */
    AdsCncBytes clause;   /* the requirement that defines it */
    uint32_t kind;        /* AdsCncFieldKind */
    uint32_t size;        /* bytes of the field or of one item; 0 if they vary */
    uint32_t is_count;    /* 1: counts the items or bytes of the next field */
    uint32_t is_list;     /* 1: one item for each of its numbers */
} AdsCncFieldInfo;

typedef enum AdsCncTypeKind {
    ADS_CNC_TYPE_BOOLEAN = 0,
    ADS_CNC_TYPE_UNSIGNED = 1,
    ADS_CNC_TYPE_SIGNED = 2,
    ADS_CNC_TYPE_FLOAT = 3,
    ADS_CNC_TYPE_TEXT = 4
} AdsCncTypeKind;

/* A type of variables, elements and objects. */
typedef struct AdsCncType {
    AdsCncBytes name;         /* of variables and elements: "SGN32" */
    AdsCncBytes object_name;  /* of objects: "DINT" */
    uint32_t code;            /* in a variable's description; 0 if no variable has the type */
    uint32_t kind;            /* AdsCncTypeKind */
    uint32_t size;            /* bytes of an element; 0 for text */
} AdsCncType;

/* The number of this name, or ADS_CNC_NONE. A function is found by either of its names. */
uint32_t ads_cnc_function(const char *name, uint32_t length);
uint32_t ads_cnc_stream(const char *name, uint32_t length);
uint32_t ads_cnc_field(uint32_t stream, const char *name, uint32_t length);

/* What has this number, from 0 on; false beyond the last. */
bool ads_cnc_function_info(uint32_t number, AdsCncFunctionInfo *info);
bool ads_cnc_stream_info(uint32_t number, AdsCncStreamInfo *info);
bool ads_cnc_field_info(uint32_t stream, uint32_t number, AdsCncFieldInfo *info);
bool ads_cnc_type(uint32_t number, AdsCncType *info);

/* The name of an AdsCncArgument, from 1 on; false beyond the last. */
bool ads_cnc_argument_name(uint32_t number, AdsCncBytes *name);

/* ---------------------------------------------------------------------- addresses and names */

/* An index group in words; none where a group has no such part. */
typedef struct AdsCncGroup {
    AdsCncBytes task;          /* "COM" or "SDA/GEO" */
    AdsCncBytes access;        /* "element" or "object" */
    AdsCncBytes addressing;    /* "index" or "logical" */
    AdsCncBytes table;         /* of COM: "channel" or "axis" */
    AdsCncBytes object_class;  /* of SDA and GEO: "decoder" and so on */
    AdsCncBytes attribute;     /* of SDA and GEO: "content", "name", "type", "length", "unit", "write flag" or
                                  "object address" */
    uint32_t instance;         /* channel, axis or spindle; 0 for none */
} AdsCncGroup;

/* The parts of an index group; false for one that is not documented. */
bool ads_cnc_group(uint32_t index_group, AdsCncGroup *parts);

/* The index offset of an element of an axis, axis 0 being the channel itself, and back. The stride is 0x10000
 * for SDA and GEO; for COM the manuals have both 0x10000 and 0x1000. */
bool ads_cnc_offset(uint32_t stride, uint32_t axis, uint32_t element, uint32_t *offset, AdsCncError *error);
bool ads_cnc_offset_parts(uint32_t stride, uint32_t offset, uint32_t *axis, uint32_t *element,
                          AdsCncError *error);

/* Takes the name of a variable apart, such as V.G.NP[0].V[1]. Of the fields that this gives, field is 0 for
 * the kind (V.G), 1 for the name of a part and 2 for an index, which is `number`; record is which part, item
 * which of its indices. */
bool ads_cnc_path(const uint8_t *name, uint32_t length, AdsCncField *parts, uint32_t room, uint32_t *count,
                  AdsCncError *error);

/* --------------------------------------------------------------- frames, without an ADS library */

typedef struct AdsCncAddress {
    uint8_t net_id[6];
    uint16_t port;
} AdsCncAddress;

enum { ADS_CNC_REQUEST = 4, ADS_CNC_RESPONSE = 5 };

/* An AMS/TCP frame, without its lengths. */
typedef struct AdsCncFrame {
    AdsCncAddress target;
    AdsCncAddress source;
    uint32_t command;
    uint32_t state_flags;  /* ADS_CNC_REQUEST or ADS_CNC_RESPONSE */
    uint32_t error;        /* AMS error number, 0 for none */
    uint32_t invoke_id;    /* the response has that of its request */
    AdsCncBytes data;      /* ads_cnc_call_write makes that of a request; of a reply it is the stream
                              "read-reply", "write-reply" or "read-write-reply" */
} AdsCncFrame;

/* Writes a frame: 38 bytes and its data. */
bool ads_cnc_frame_write(const AdsCncFrame *frame, uint8_t *buffer, uint32_t room, uint32_t *length,
                         AdsCncError *error);

/* Reads the frame at the front of what was received. `used` is its length, or 0 if bytes are missing. After
 * an error the connection cannot be used any further. */
bool ads_cnc_frame_read(const uint8_t *data, uint32_t length, uint32_t max_data, AdsCncFrame *frame,
                        uint32_t *used, AdsCncError *error);

/* The data of the frame of a call: at most 16 bytes more than the data of the call. */
bool ads_cnc_call_write(const AdsCncCall *call, uint8_t *buffer, uint32_t room, uint32_t *length,
                        AdsCncError *error);

/* The call of a request's frame. */
bool ads_cnc_call_read(const AdsCncFrame *frame, AdsCncCall *call, AdsCncError *error);

/* ------------------------------------------------------------- sender of an NC program */

/* In memory of the caller; what is in it is the library's. It may be copied. Memory that was never started
 * must at least be zero: the functions then return false. */
typedef struct AdsCncSender {
    uint64_t opaque[152];
} AdsCncSender;

enum { ADS_CNC_ACCEPTED = 0, ADS_CNC_BUSY = 1, ADS_CNC_REJECTED = 2 };

typedef enum AdsCncSenderState {
    ADS_CNC_SENDER_READY = 0,
    ADS_CNC_SENDER_IN_FLIGHT = 1,
    ADS_CNC_SENDER_WAITING = 2,  /* busy: the same packet comes again */
    ADS_CNC_SENDER_STOPPED = 3,  /* rejected */
    ADS_CNC_SENDER_DONE = 4
} AdsCncSenderState;

typedef struct AdsCncProgress {
    uint32_t state;       /* AdsCncSenderState */
    uint32_t packets;     /* accepted */
    uint32_t lines;       /* accepted */
    uint32_t bytes;       /* accepted, with CR LF after each line */
    uint32_t left_lines;
    uint32_t left_bytes;
    uint32_t busy_count;  /* for the present packet */
} AdsCncProgress;

/* Begins with a text, which must stay where it is, unchanged, as long as the sender is used. Every line is
 * checked first: on an error of kind ADS_CNC_LINE, `expected` is the line and `offset` the column. */
bool ads_cnc_sender_start(AdsCncSender *sender, const uint8_t *text, uint32_t length, AdsCncError *error);

/* The packet to write by WriteProgramStream, valid until the next call; false if none is left. */
bool ads_cnc_sender_packet(AdsCncSender *sender, AdsCncBytes *packet);

/* What became of it: ADS_CNC_ACCEPTED; ADS_CNC_BUSY, then wait about half a second; ADS_CNC_REJECTED, also
 * if the reply was lost: a repetition might run lines twice. */
bool ads_cnc_sender_acknowledge(AdsCncSender *sender, uint32_t acknowledgement);

/* What the ADS result of a write means (assumed: no manual says so). */
uint32_t ads_cnc_acknowledgement(uint32_t ads_error);

bool ads_cnc_sender_progress(const AdsCncSender *sender, AdsCncProgress *progress);

/* ------------------------------------------------------------- host of services */

/* As AdsCncSender. One host serves all services of a channel. */
typedef struct AdsCncHost {
    uint64_t opaque[72];
} AdsCncHost;

/* The UUID of a service. */
typedef struct AdsCncServiceId {
    uint8_t text[36];
} AdsCncServiceId;

typedef enum AdsCncStepKind {
    ADS_CNC_STEP_WAIT = 0,   /* let time pass, then ads_cnc_host_event(host, ADS_CNC_POLL) */
    ADS_CNC_STEP_READ = 1,   /* read `variable` by ReadByName, then ads_cnc_host_read */
    ADS_CNC_STEP_WRITE = 2,  /* write `data` to `variable` by WriteByName, then ADS_CNC_WRITTEN or _FAILED */
    ADS_CNC_STEP_SERVE = 3   /* serve the request `data`, then ads_cnc_host_answer */
} AdsCncStepKind;

typedef struct AdsCncHostStep {
    uint32_t kind;           /* AdsCncStepKind */
    uint32_t service;        /* which of the IDs */
    uint32_t request_state;
    AdsCncBytes variable;    /* name of a variable */
    AdsCncBytes data;        /* a value, or the text of a request in CP1252; valid until the next call */
} AdsCncHostStep;

enum { ADS_CNC_WRITTEN = 0, ADS_CNC_FAILED = 1, ADS_CNC_POLL = 2, ADS_CNC_RESTART = 3 };
enum { ADS_CNC_NO_OUTCOME = 0, ADS_CNC_ANSWERED = 1, ADS_CNC_ABANDONED = 2 };

/* "560AACBF-6335-44a9-895A-8B27F3ED5E47" */
bool ads_cnc_service_id(const char *text, uint32_t length, AdsCncServiceId *id, AdsCncError *error);

/* Begins with these services, whose IDs must stay where they are as long as the host is used. */
bool ads_cnc_host_start(AdsCncHost *host, const AdsCncServiceId *ids, uint32_t count, AdsCncError *error);

/* What to do next; the same until it is reported as done. */
bool ads_cnc_host_step(const AdsCncHost *host, AdsCncHostStep *step);

/* The value that was read. On an error the host waits or reads again. */
bool ads_cnc_host_read(AdsCncHost *host, const uint8_t *value, uint32_t length, AdsCncError *error);

/* The response, CP1252 of at most 127 characters, and its state, not 0. On an error nothing is written, and
 * another answer can be given. */
bool ads_cnc_host_answer(AdsCncHost *host, const uint8_t *response, uint32_t length, uint32_t response_state,
                         AdsCncError *error);

/* ADS_CNC_WRITTEN: the write was done. ADS_CNC_FAILED: it may have been done. ADS_CNC_POLL: the wait is over.
 * ADS_CNC_RESTART: the CNC was reset, or the connection is new. */
bool ads_cnc_host_event(AdsCncHost *host, uint32_t event);

/* Of the last answer: ADS_CNC_ANSWERED, or ADS_CNC_ABANDONED if the program did not wait for it. */
uint32_t ads_cnc_host_outcome(const AdsCncHost *host);

#ifdef __cplusplus
}
#endif

#endif /* ADS_CNC_H */
