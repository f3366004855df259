/*
 * ads-cnc: a codec for the byte streams that read and write an ISG/TwinCAT CNC over ADS, for C11, C++17 and
 * languages that call C. MIT or Apache-2.0, at your option.
 *
 *            input                    function              output
 *   client   an AdsCncRequest         ads_cnc_encode        the AdsCncCall to send by the ADS library
 *            the data of the reply    ads_cnc_decode_reply  a list of fields
 *   server   a received AdsCncCall    ads_cnc_dispatch      an AdsCncRequest
 *            the fields of a reply    ads_cnc_build         the data of the reply
 *
 * Memory. The library has no allocator and no globals, and there is nothing to free. The caller provides all
 * memory. Pointers into a buffer are valid while the buffer is unchanged. Any thread may call any function,
 * but no thread may write memory that another thread uses at the same time. Input and output buffers must not
 * overlap.
 *
 * Errors. Functions with the parameter `error` return true on success; otherwise they return false and write an
 * AdsCncError to `error`.
 * Any number is safe to pass. An invalid pointer, and a length that exceeds the memory at its pointer, are not.
 * Pass null for no bytes, and for results that you do not need. After an error, the contents of output buffers
 * are unspecified.
 *
 * Numbers. The numbers of functions, streams and fields can change between versions: look them up by name
 * once, at the start. ads_cnc_abi() must return ADS_CNC_ABI.
 *
 * Texts. Names in requests and streams are CP1252, as on the wire. ASCII needs no conversion;
 * ads_cnc_text_from_utf8 converts UTF-8 to CP1252, ads_cnc_text_to_utf8 converts back. Names and descriptions
 * of the library itself, as in errors and tables, are UTF-8 without a NUL: print them with "%.*s".
 */
#ifndef ADS_CNC_H
#define ADS_CNC_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The ABI that this header describes: the minor version of the library. */
#define ADS_CNC_ABI 2

/* Means no function, stream or field. */
#define ADS_CNC_NONE 0xFFFFFFFFu

/* The ABI of the library. */
uint32_t ads_cnc_abi(void);

/* ------------------------------------------------------------------------------------- structs */

/* Bytes of the caller or constant bytes of the library. The pointer may be null if the length is 0. */
typedef struct AdsCncBytes {
    const uint8_t *data;
    uint32_t length;
} AdsCncBytes;

/* The reason why a function returned false. To print it:
 *
 *   fprintf(stderr, "%.*s: %.*s at offset %u: %.*s, expected %u, found %u\n",
 *           (int)e.subject.length, (const char *)e.subject.data, (int)e.name.length, ...);
 */
typedef struct AdsCncError {
    uint32_t kind;       /* AdsCncErrorKind */
    uint32_t stream;     /* the stream at fault, or ADS_CNC_NONE */
    uint32_t field;      /* the field at fault; ADS_CNC_NONE for the stream as a whole, or without a stream */
    uint32_t offset;     /* offset of the fault in the stream, in bytes; in a text or name, in characters */
    uint32_t expected;   /* a number whose meaning depends on the kind */
    uint32_t found;      /* a number whose meaning depends on the kind */
    AdsCncBytes subject; /* name of the stream or other subject at fault */
    AdsCncBytes name;    /* name of the field or argument, or empty */
    AdsCncBytes text;    /* description of the kind */
} AdsCncError;

typedef enum AdsCncErrorKind {
    /* errors of a stream or value; each comment lists `expected` and `found`, in this order */
    ADS_CNC_OTHER_ERROR = 0,
    ADS_CNC_TRUNCATED = 1,     /* bytes (of a UUID or name: characters) that the field needs, those found */
    ADS_CNC_TRAILING = 2,      /* length of the stream, length of the input */
    ADS_CNC_TOO_LONG = 3,      /* maximum length, length */
    ADS_CNC_TOO_MANY = 4,      /* maximum count, count */
    ADS_CNC_MISSING_NUL = 5,   /* maximum length with the NUL, bytes found */
    ADS_CNC_INNER_NUL = 6,     /* 0, index of the NUL in the text */
    ADS_CNC_NOT_CP1252 = 7,    /* 0, code point */
    ADS_CNC_NOT_DECIMAL = 8,   /* 0, code point */
    ADS_CNC_DIGITS = 9,        /* maximum number of digits, digits found */
    ADS_CNC_UNEXPECTED = 10,   /* 0, code point */
    ADS_CNC_MISSING = 11,
    ADS_CNC_OUT_OF_RANGE = 12, /* nearest permitted value, value */
    ADS_CNC_MISMATCH = 13,     /* required value, value found; or their lengths */
    ADS_CNC_CONTENT = 14,      /* 0, index offset of a function instead of content */
    ADS_CNC_BUFFER = 15,       /* bytes needed, bytes available */
    /* errors of the caller */
    ADS_CNC_POINTER = 32,      /* null pointer that must not be null, or length beyond the address space */
    ADS_CNC_NO_FUNCTION = 33,
    ADS_CNC_NO_STREAM = 34,
    ADS_CNC_NO_FIELD = 35,
    ADS_CNC_ARGUMENT = 36,     /* value that the function does not accept; name is the argument or field */
    ADS_CNC_ROOM = 37,         /* items or bytes needed, room available */
    ADS_CNC_NOT_STARTED = 38,  /* sender or host that is not started */
    ADS_CNC_LINE = 39,         /* line; length of the line if it is too long, otherwise the invalid byte;
                                  `offset` is the column */
    /* errors of a received call */
    ADS_CNC_NO_PORT = 40,      /* 0, the port */
    ADS_CNC_NO_GROUP = 41,     /* 0, the index group */
    ADS_CNC_NO_OFFSET = 42,    /* 0, the index offset */
    ADS_CNC_COMMAND = 43       /* command of the function, command of the call */
} AdsCncErrorKind;

/* The arguments of any function. Set the arguments that ads_cnc_function_info lists for the function. Two more
 * arguments may be set, although they are not listed: `by_index` for a function with `channel`, and `axis` for a
 * list of objects. All other arguments must be zero: `AdsCncRequest request = {0};`. */
typedef struct AdsCncRequest {
    uint32_t function;      /* number from ads_cnc_function */
    uint32_t channel;       /* from 1; 0 is the platform, for lists of objects and object addresses; for the object
                               address of a spindle, the index of the spindle */
    uint32_t by_index;      /* 1: `channel` is the index among the active channels, from 1, not the logical
                               number */
    uint32_t axis;          /* axis of the channel, from 1; a platform axis for lists of objects with channel 0; in
                               an object address, 0 is the channel itself */
    uint32_t index;         /* variables from 0; parameters and objects from 1 */
    uint32_t count;         /* number of descriptors to read */
    uint32_t size;          /* maximum number of bytes of content to read */
    uint32_t handle;        /* handle of the variable */
    uint32_t index_group;   /* index group of the content of an element, or of an object */
    uint32_t index_offset;  /* index offset of the content of an element, or of an object */
    AdsCncBytes kind;       /* for variables: "V.E", "V.G", "V.A" or empty for all; for parameters: "P", "V.L",
                               "V.P", "V.S"; for object addresses, the class: "position controller",
                               "interpolator", "decoder", "HLD", "path preparation", "spindle" */
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

/* An ADS call. */
typedef struct AdsCncCall {
    uint32_t port;         /* AMS port: 551 GEO, 552 SDA, 553 COM */
    uint32_t command;      /* AMS command: 2 Read, 3 Write, 9 ReadWrite */
    uint32_t index_group;
    uint32_t index_offset;
    uint32_t read_length;  /* maximum length of the reply in bytes; 0 for a Write */
    AdsCncBytes data;      /* data of the request; empty for a Read */
} AdsCncCall;

/* A field of a decoded stream, or one item of a field that is a list. */
typedef struct AdsCncField {
    uint32_t field;   /* number of the field */
    uint32_t record;  /* index of the record in a stream of records, from 0 */
    uint32_t item;    /* index of the item in a list, from 0 */
    uint32_t offset;  /* offset of its bytes in the decoded data */
    uint32_t length;  /* length in bytes; for a text including its NUL and the bytes after it */
    uint32_t number;  /* the value of a number of at most four bytes; otherwise 0 */
} AdsCncField;

/* A field of a stream to build, or one item of a field that is a list. */
typedef struct AdsCncPart {
    uint32_t field;
    uint32_t number;   /* the value of a number of at most four bytes, if data.data is null */
    AdsCncBytes data;  /* the bytes of any other field; for a text including its NUL, if it has one */
} AdsCncPart;

/* --------------------------------------------------------------------------------- client */

/* Encodes the data of a request to `buffer` and writes the call to send to `call`. 2048 bytes of room are
 * sufficient for all requests except WriteElement and WriteObject. */
bool ads_cnc_encode(const AdsCncRequest *request, uint8_t *buffer, uint32_t room, AdsCncCall *call,
                    AdsCncError *error);

/* Checks the data of the reply to a request, and returns its fields in the order of the table and their number
 * in `count`. If `fields` is null, the fields are only counted. A reply to a Write has no fields. Pass the
 * received length, not the read length: see "Common mistakes" in codec/bindings/README.md. */
bool ads_cnc_decode_reply(const AdsCncRequest *request, const uint8_t *data, uint32_t length,
                          AdsCncField *fields, uint32_t room, uint32_t *count, AdsCncError *error);

/* --------------------------------------------------------------------------------- server */

/* Decodes a received call to its function and arguments. Names and values point into the data of the call,
 * indices to `indices`, which needs room for 510. After an error, `ads_error` is the ADS error number for the
 * response. The server must check that its reply fits the read length of the call. */
bool ads_cnc_dispatch(const AdsCncCall *call, uint32_t *indices, uint32_t room, AdsCncRequest *request,
                      uint32_t *ads_error, AdsCncError *error);

/* -------------------------------------------------------------------------------- streams */

/* Checks a stream and returns its fields, like ads_cnc_decode_reply. */
bool ads_cnc_decode(uint32_t stream, const uint8_t *data, uint32_t length, AdsCncField *fields, uint32_t room,
                    uint32_t *count, AdsCncError *error);

/* Builds a stream from its fields. Pass the fields in the order of the table, record by record; each item of a
 * list is its own part. Counts may be omitted; they are then computed from the items. It is an error if the
 * result would not decode to the same fields. */
bool ads_cnc_build(uint32_t stream, const AdsCncPart *parts, uint32_t count, uint8_t *buffer, uint32_t room,
                   uint32_t *length, AdsCncError *error);

/* Converts CP1252, up to the first NUL or the end, to UTF-8 without a NUL. `length` is the length of the
 * result; it is also set if the room is too small and the function returns false. */
bool ads_cnc_text_to_utf8(const uint8_t *data, uint32_t size, uint8_t *buffer, uint32_t room,
                          uint32_t *length, AdsCncError *error);

/* Converts UTF-8 to CP1252 without a NUL; `length` as above. A character that CP1252 does not contain is an
 * error, whose offset counts characters. */
bool ads_cnc_text_from_utf8(const uint8_t *data, uint32_t size, uint8_t *buffer, uint32_t room,
                            uint32_t *length, AdsCncError *error);

/* --------------------------------------------------------------------------------- tables */

typedef enum AdsCncEffect {
    ADS_CNC_EFFECT_NONE = 0,
    ADS_CNC_EFFECT_WRITE = 1,  /* changes a value */
    ADS_CNC_EFFECT_MOTION = 2  /* may move an axis */
} AdsCncEffect;

typedef struct AdsCncFunctionInfo {
    AdsCncBytes name;         /* name in reports: "read variable value by name" */
    AdsCncBytes operation;    /* name in programs: "ReadByName" */
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
    AdsCncBytes title;     /* short description */
    uint32_t max;          /* maximum length in bytes */
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
    AdsCncBytes meaning;  /* short description */
    AdsCncBytes clause;   /* ID of the requirement that defines the field */
    uint32_t kind;        /* AdsCncFieldKind */
    uint32_t size;        /* size of the field or of one item in bytes; 0 if it varies */
    uint32_t is_count;    /* 1: counts the items or bytes of the next field */
    uint32_t is_list;     /* 1: a list, with one item for each number */
} AdsCncFieldInfo;

typedef enum AdsCncTypeKind {
    ADS_CNC_TYPE_BOOLEAN = 0,
    ADS_CNC_TYPE_UNSIGNED = 1,
    ADS_CNC_TYPE_SIGNED = 2,
    ADS_CNC_TYPE_FLOAT = 3,
    ADS_CNC_TYPE_TEXT = 4
} AdsCncTypeKind;

/* A type of variables, elements or objects. */
typedef struct AdsCncType {
    AdsCncBytes name;         /* name for variables and elements: "SGN32" */
    AdsCncBytes object_name;  /* name for objects: "DINT" */
    uint32_t code;            /* code in a description; 0 if variables do not use the type */
    uint32_t kind;            /* AdsCncTypeKind */
    uint32_t size;            /* size of an element in bytes; 0 for text */
} AdsCncType;

/* The number of the function, stream or field with this name, or ADS_CNC_NONE. A function can be found by
 * either of its names. */
uint32_t ads_cnc_function(const char *name, uint32_t length);
uint32_t ads_cnc_stream(const char *name, uint32_t length);
uint32_t ads_cnc_field(uint32_t stream, const char *name, uint32_t length);

/* The function, stream, field or type with this number, from 0; false if no entry has this number. */
bool ads_cnc_function_info(uint32_t number, AdsCncFunctionInfo *info);
bool ads_cnc_stream_info(uint32_t number, AdsCncStreamInfo *info);
bool ads_cnc_field_info(uint32_t stream, uint32_t number, AdsCncFieldInfo *info);
bool ads_cnc_type(uint32_t number, AdsCncType *info);

/* The name of an AdsCncArgument, from 1; false if no argument has this number. */
bool ads_cnc_argument_name(uint32_t number, AdsCncBytes *name);

/* ---------------------------------------------------------------------- addresses and names */

/* The parts of an index group, as words; parts that a group does not have are empty. */
typedef struct AdsCncGroup {
    AdsCncBytes task;          /* "COM" or "SDA/GEO" */
    AdsCncBytes access;        /* "element" or "object" */
    AdsCncBytes addressing;    /* "index" or "logical" */
    AdsCncBytes table;         /* for COM: "channel" or "axis" */
    AdsCncBytes object_class;  /* for SDA and GEO: "decoder" and so on */
    AdsCncBytes attribute;     /* for SDA and GEO: "content", "name", "type", "length", "unit", "write flag" or
                                  "object address" */
    uint32_t instance;         /* number or index of the channel, axis or spindle; 0 if the group has none */
} AdsCncGroup;

/* Parses an index group; returns false if it is not documented. */
bool ads_cnc_group(uint32_t index_group, AdsCncGroup *parts);

/* Converts axis and element to an index offset, and back. Axis 0 is the channel itself. The stride is 0x10000;
 * for axes of COM and for a platform axis of the HLD, the manuals also print offsets with 0x1000 (E-01). */
bool ads_cnc_offset(uint32_t stride, uint32_t axis, uint32_t element, uint32_t *offset, AdsCncError *error);
bool ads_cnc_offset_parts(uint32_t stride, uint32_t offset, uint32_t *axis, uint32_t *element,
                          AdsCncError *error);

/* Parses the name of a variable, such as V.G.NP[0].V[1]. In the result, `field` is 0 for the kind (V.G), 1 for
 * the name of a part and 2 for an index, whose value is `number`; `record` is the index of the part, `item`
 * the position of the index in the part. */
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
    uint32_t state_flags;  /* such as ADS_CNC_REQUEST or ADS_CNC_RESPONSE */
    uint32_t error;        /* AMS error number, 0 for none */
    uint32_t invoke_id;    /* a response has the invoke ID of its request */
    AdsCncBytes data;      /* for a request, from ads_cnc_call_write; for the reply to it, the stream "read-reply",
                              "write-reply" or "read-write-reply" */
} AdsCncFrame;

/* Encodes a frame: 38 bytes and its data. */
bool ads_cnc_frame_write(const AdsCncFrame *frame, uint8_t *buffer, uint32_t room, uint32_t *length,
                         AdsCncError *error);

/* Decodes the first frame in the received data. A frame with more than `max_data` bytes of data is an error.
 * `used` is its length, or 0 if the frame is not complete yet. After an error, no further frame can be found:
 * close the connection. */
bool ads_cnc_frame_read(const uint8_t *data, uint32_t length, uint32_t max_data, AdsCncFrame *frame,
                        uint32_t *used, AdsCncError *error);

/* Encodes the data of the frame for a call: at most 16 bytes more than the data of the call. */
bool ads_cnc_call_write(const AdsCncCall *call, uint8_t *buffer, uint32_t room, uint32_t *length,
                        AdsCncError *error);

/* Decodes the call in the frame of a Read, Write or ReadWrite request. Does not check the state flags. */
bool ads_cnc_call_read(const AdsCncFrame *frame, AdsCncCall *call, AdsCncError *error);

/* ------------------------------------------------------------- sender of an NC program */

/* A sender in memory of the caller; the contents are private to the library. A sender may be copied. Before
 * ads_cnc_sender_start, the memory must be zero; the other functions then return false. They also return false
 * after an error of ads_cnc_sender_start, even if the sender was started before. */
typedef struct AdsCncSender {
    uint64_t opaque[152];
} AdsCncSender;

enum { ADS_CNC_ACCEPTED = 0, ADS_CNC_BUSY = 1, ADS_CNC_REJECTED = 2 };

typedef enum AdsCncSenderState {
    ADS_CNC_SENDER_READY = 0,
    ADS_CNC_SENDER_IN_FLIGHT = 1,
    ADS_CNC_SENDER_WAITING = 2,  /* the CNC was busy: the same packet is returned again */
    ADS_CNC_SENDER_STOPPED = 3,  /* a packet was rejected */
    ADS_CNC_SENDER_DONE = 4
} AdsCncSenderState;

typedef struct AdsCncProgress {
    uint32_t state;       /* AdsCncSenderState */
    uint32_t packets;     /* number of accepted packets */
    uint32_t lines;       /* number of accepted lines */
    uint32_t bytes;       /* number of accepted bytes, including CR LF after each line */
    uint32_t left_lines;
    uint32_t left_bytes;
    uint32_t busy_count;  /* number of ADS_CNC_BUSY for the current packet */
} AdsCncProgress;

/* Starts sending a text, which must stay in place unchanged while the sender is used. All lines are checked
 * first: in an error of kind ADS_CNC_LINE, `expected` is the line and `offset` the column. */
bool ads_cnc_sender_start(AdsCncSender *sender, const uint8_t *text, uint32_t length, AdsCncError *error);

/* The packet to write by WriteProgramStream, valid until the next call; false if no packet is left or one was
 * rejected. */
bool ads_cnc_sender_packet(AdsCncSender *sender, AdsCncBytes *packet);

/* Reports the result of writing the packet: ADS_CNC_ACCEPTED; ADS_CNC_BUSY, after which the caller waits about
 * half a second; or ADS_CNC_REJECTED, also for a lost reply, because a repetition might execute lines twice.
 * Returns false if no packet is in flight, or for any other number. */
bool ads_cnc_sender_acknowledge(AdsCncSender *sender, uint32_t acknowledgement);

/* The acknowledgement for the ADS result of a write (assumed: the manuals do not document it). */
uint32_t ads_cnc_acknowledgement(uint32_t ads_error);

bool ads_cnc_sender_progress(const AdsCncSender *sender, AdsCncProgress *progress);

/* ------------------------------------------------------------- host of services */

/* A host in memory of the caller, with the same rules as for AdsCncSender. One host serves all services of
 * a channel. */
typedef struct AdsCncHost {
    uint64_t opaque[72];
} AdsCncHost;

/* The UUID of a service. */
typedef struct AdsCncServiceId {
    uint8_t text[36];
} AdsCncServiceId;

typedef enum AdsCncStepKind {
    ADS_CNC_STEP_WAIT = 0,   /* wait for some time, then ads_cnc_host_event(host, ADS_CNC_POLL) */
    ADS_CNC_STEP_READ = 1,   /* read `variable` by ReadByName, then ads_cnc_host_read */
    ADS_CNC_STEP_WRITE = 2,  /* write `data` to `variable` by WriteByName, then ADS_CNC_WRITTEN or _FAILED */
    ADS_CNC_STEP_SERVE = 3   /* serve the request `data`, then ads_cnc_host_answer */
} AdsCncStepKind;

typedef struct AdsCncHostStep {
    uint32_t kind;           /* AdsCncStepKind */
    uint32_t service;        /* to serve a request: index of the service in the IDs, from 0 */
    uint32_t request_state;  /* to serve a request: its state */
    AdsCncBytes variable;    /* name of a variable */
    AdsCncBytes data;        /* a value, or the text of a request in CP1252; valid until the next call,
                                to which it can be passed */
} AdsCncHostStep;

enum { ADS_CNC_WRITTEN = 0, ADS_CNC_FAILED = 1, ADS_CNC_POLL = 2, ADS_CNC_RESTART = 3 };
enum { ADS_CNC_NO_OUTCOME = 0, ADS_CNC_ANSWERED = 1, ADS_CNC_ABANDONED = 2 };

/* Parses a UUID such as "560AACBF-6335-44a9-895A-8B27F3ED5E47". */
bool ads_cnc_service_id(const char *text, uint32_t length, AdsCncServiceId *id, AdsCncError *error);

/* Starts a host of these services. The IDs must stay in place while the host is used. */
bool ads_cnc_host_start(AdsCncHost *host, const AdsCncServiceId *ids, uint32_t count, AdsCncError *error);

/* The next step. Returns the same step until a read value, an answer or an event is reported. */
bool ads_cnc_host_step(const AdsCncHost *host, AdsCncHostStep *step);

/* Reports the value that was read. After an error, the host waits or reads again. */
bool ads_cnc_host_read(AdsCncHost *host, const uint8_t *value, uint32_t length, AdsCncError *error);

/* Answers the request with CP1252 text of at most 127 characters and a state that is not 0. After an error,
 * nothing is written, and the caller can pass another answer. */
bool ads_cnc_host_answer(AdsCncHost *host, const uint8_t *response, uint32_t length, uint32_t response_state,
                         AdsCncError *error);

/* Reports an event. ADS_CNC_WRITTEN: the write was done. ADS_CNC_FAILED: the step failed; a write may have
 * taken effect. ADS_CNC_POLL: the wait is over. ADS_CNC_RESTART: the CNC was reset, or the connection is new. */
bool ads_cnc_host_event(AdsCncHost *host, uint32_t event);

/* The outcome of the last answer: ADS_CNC_ANSWERED, or ADS_CNC_ABANDONED if the variables no longer contained the
 * request. It is ADS_CNC_NO_OUTCOME before the first answer, until the outcome of an answer is known, and if
 * the host is not started. */
uint32_t ads_cnc_host_outcome(const AdsCncHost *host);

#ifdef __cplusplus
}
#endif

#endif /* ADS_CNC_H */
