/*
 * An adapter for `ads-cnc run --testee`, with a codec for all streams of the golden
 * vectors except the replies of ReadDeviceInfo and ReadState. It needs only C11 and libc:
 *
 *     cc -std=c11 -O2 -o testee testee.c
 *     ads-cnc run --testee ./testee
 *
 * To test your own codec, keep the JSON part and everything from `read_context`
 * on, and call your codec instead of `decode` and `encode`.
 */

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LONGEST_LINE ((size_t)32 * 1024 * 1024)
#define DEEPEST 64
#define COUNT_OF(array) (sizeof(array) / sizeof(array)[0])

static const char HEX[] = "0123456789abcdef", DIGITS[] = "0123456789";

/* ---- Growing buffers ---------------------------------------------------- */

typedef struct {
    unsigned char *data;
    size_t size, room;
} Bytes;

static void append(Bytes *b, const void *data, size_t size) {
    if (size > b->room - b->size) {
        b->room = (b->size + size) * 2;
        b->data = realloc(b->data, b->room);
        if (!b->data) {
            fputs("out of memory\n", stderr);
            exit(EXIT_FAILURE);
        }
    }
    if (size > 0) memcpy(b->data + b->size, data, size);
    b->size += size;
}

static void append_byte(Bytes *b, unsigned byte) {
    append(b, &(unsigned char) { (unsigned char)byte }, 1);
}

static void set_u32(Bytes *b, size_t at, size_t number) {
    for (size_t i = 0; i < 4; i++) b->data[at + i] = (unsigned char)(number >> 8 * i & 0xff);
}

static uint32_t get_u32(const unsigned char *at) {
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

/* Appends at most 255 characters; `append` is for texts of any length. */
static void print(Bytes *b, const char *format, ...) {
    char piece[256];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(piece, sizeof piece, format, arguments);
    va_end(arguments);
    if (length > 0 && (size_t)length < sizeof piece) append(b, piece, (size_t)length);
}

/* Separates the bytes by `blank`: " " in a value, as in the vectors, "" elsewhere. */
static void print_hex(Bytes *b, const unsigned char *data, size_t size, const char *blank) {
    for (size_t i = 0; i < size; i++) {
        if (i > 0) append(b, blank, strlen(blank));
        append(b, (char[]) { HEX[data[i] >> 4], HEX[data[i] & 15] }, 2);
    }
}

/* ---- JSON ---------------------------------------------------------------
 * `skip_value` checks the syntax of a line once. After that, a value is a pointer
 * to its first character in the line: nothing is copied, and a line needs no more
 * memory than its own length. A missing value is NULL, and a search in a missing
 * value returns NULL. */

typedef const char *Json;

static Json skip_space(Json p) { return p + strspn(p, " \t\r\n"); }

static int hex_digit(unsigned c) {
    const char *digit = c > 0 && c < 128 ? strchr(HEX, tolower((int)c)) : NULL;
    return digit ? (int)(digit - HEX) : -1;
}

/* The skip functions return the position after the skipped text, or NULL for wrong
 * syntax. They stop at the NUL after the line, so they need no length. */
static Json skip_string(Json p) {
    if (*p++ != '"') return NULL;
    for (; *p != '"'; p++) {
        if ((unsigned char)*p < 0x20) return NULL;
        if (*p != '\\') continue;
        if (*++p == '\0' || !strchr("\"\\/bfnrtu", *p)) return NULL;
        for (int i = *p == 'u' ? 4 : 0; i > 0; i--)
            if (hex_digit((unsigned char)*++p) < 0) return NULL;
    }
    return p + 1;
}

/* Numbers and words are checked only roughly, because nothing depends on them. */
static Json skip_value(Json p, int depth) {
    size_t plain = strspn(p, "+-.0123456789Eaeflnrstu");
    char close = *p == '{' ? '}' : ']';
    bool object = *p == '{';
    if (*p == '"') return skip_string(p);
    if (*p == '0' && isdigit((unsigned char)p[1])) return NULL;
    if (!object && *p != '[') return plain > 0 ? p + plain : NULL;
    p = skip_space(p + 1);
    if (*p == close) return p + 1;
    for (; depth < DEEPEST; p = skip_space(p + 1)) {
        if (object) {
            p = skip_string(p);
            if (!p || *(p = skip_space(p)) != ':') return NULL;
            p = skip_space(p + 1);
        }
        p = skip_value(p, depth + 1);
        if (!p || *(p = skip_space(p)) == close) return p ? p + 1 : NULL;
        if (*p != ',') return NULL;
    }
    return NULL;
}

/* The next character of a checked string. Other characters than ASCII are returned
 * as bytes or as the numbers of escapes; they only have to differ from ASCII. */
static unsigned next_character(Json *p) {
    static const char letters[] = "bfnrt", escaped[] = "\b\f\n\r\t";
    unsigned c = (unsigned char)*(*p)++;
    if (c != '\\') return c;
    c = (unsigned char)*(*p)++;
    const char *letter = strchr(letters, (int)c);
    if (c != 'u') return letter ? (unsigned char)escaped[letter - letters] : c;
    c = 0;
    for (int i = 0; i < 4; i++) c = c * 16 + (unsigned)hex_digit((unsigned char)*(*p)++);
    return c;
}

static bool string_is(Json string, const char *text) {
    if (!string || *string++ != '"') return false;
    while (*string != '"' && *text != '\0')
        if (next_character(&string) != (unsigned char)*text++) return false;
    return *string == '"' && *text == '\0';
}

static Json member(Json object, const char *key) {
    if (!object || *object != '{') return NULL;
    for (Json p = skip_space(object + 1); *p != '}';) {
        bool found = string_is(p, key);
        p = skip_space(skip_space(skip_string(p)) + 1);
        if (found) return p;
        p = skip_space(skip_value(p, 0));
        if (*p == ',') p = skip_space(p + 1);
    }
    return NULL;
}

static Json first_item(Json list) {
    Json p = list && *list == '[' ? skip_space(list + 1) : NULL;
    return p && *p != ']' ? p : NULL;
}

static Json next_item(Json item) {
    Json p = skip_space(skip_value(item, 0));
    return *p == ',' ? skip_space(p + 1) : NULL;
}

static size_t list_length(Json list) {
    size_t length = 0;
    for (Json item = first_item(list); item; item = next_item(item)) length++;
    return length;
}

/* A number in a context: 5, "5" or "0x5". A text that does not begin with a number is 0. */
static uint64_t read_number(Json value) {
    return value ? strtoull(value + (*value == '"'), NULL, 0) : 0;
}

/* Reads pairs of hex digits, with or without blanks between the pairs. */
static bool read_hex(Json p, Bytes *bytes) {
    if (!p || *p++ != '"') return false;
    while (*p != '"') {
        unsigned c = next_character(&p);
        if (c == ' ') continue;
        int high = hex_digit(c), low = *p == '"' ? -1 : hex_digit(next_character(&p));
        if (high < 0 || low < 0) return false;
        append_byte(bytes, (unsigned)high << 4 | (unsigned)low);
    }
    return true;
}

/* ---- The codec ----------------------------------------------------------
 * A table lists the fields of each stream in order; the same functions read and
 * write them. Decoding converts `in` to JSON in `out`, encoding converts the JSON
 * record `value` to bytes in `out`. Only the first fault is stored. After a fault,
 * the functions may continue, because their output is not used; loops check for a
 * fault, so that they end. */

typedef struct {
    const char *name;
    unsigned size;
    enum { UNSIGNED, SIGNED, REAL, ADDRESS, TEXT } kind;
} Type;

static const Type TYPES[] = {
    { "BOOLEAN", 1, UNSIGNED }, { "UNS08", 1, UNSIGNED }, { "UNS16", 2, UNSIGNED },
    { "UNS32", 4, UNSIGNED },   { "REAL64", 8, REAL },    { "REAL32", 4, REAL },
    { "SGN08", 1, SIGNED },     { "SGN16", 2, SIGNED },   { "SGN32", 4, SIGNED },
    { "BOOL", 1, UNSIGNED },    { "BYTE", 1, UNSIGNED },  { "WORD", 2, UNSIGNED },
    { "DWORD", 4, UNSIGNED },   { "LWORD", 8, UNSIGNED }, { "SINT", 1, SIGNED },
    { "INT", 2, SIGNED },       { "DINT", 4, SIGNED },    { "LINT", 8, SIGNED },
    { "REAL", 4, REAL },        { "LREAL", 8, REAL },     { "STRING", 1, TEXT },
    { "NETID", 6, ADDRESS },
};

#define BOOLEAN (&TYPES[0])
#define UNS08 (&TYPES[1])
#define UNS16 (&TYPES[2])
#define UNS32 (&TYPES[3])
#define REAL64 (&TYPES[4])
#define NETID (&TYPES[COUNT_OF(TYPES) - 1])

typedef struct {
    bool encoding;
    const unsigned char *in;
    size_t at, end;
    Json value;
    Bytes *out;
    bool framed; /* inside an AMS frame, whose value omits the lengths */
    /* From the context of the case. */
    const Type *type;
    uint64_t count, stride, base;
    bool based;
    /* Class and offset of the first fault. */
    const char *fault;
    size_t fault_at;
} Codec;

static size_t here(const Codec *c) { return c->encoding ? c->out->size : c->at; }
static size_t left(const Codec *c) { return c->end - c->at; }

/* The field with this name; without a name, the current item of a list. */
static Json field(const Codec *c, const char *name) {
    return name ? member(c->value, name) : c->value;
}

static void fail(Codec *c, const char *class, size_t at) {
    if (c->fault) return;
    c->fault = class;
    c->fault_at = at;
}

static void start(Codec *c, const char *name, const char *opening) {
    if (!strchr("{[:", c->out->data[c->out->size - 1])) append_byte(c->out, ',');
    if (name) print(c->out, "\"%s\":", name);
    print(c->out, "%s", opening);
}

static uint64_t get(Codec *c, size_t size) {
    uint64_t raw = 0;
    if (size > left(c)) fail(c, "truncated", c->at);
    if (c->fault) return 0;
    for (size_t i = size; i-- > 0;) raw = raw << 8 | c->in[c->at + i];
    c->at += size;
    return raw;
}

static void put(Codec *c, size_t size, uint64_t raw) {
    for (size_t i = 0; i < size; i++) append_byte(c->out, (unsigned)(raw >> 8 * i & 0xff));
}

/* Appends a value without readable forms: a float has `bits`, but no decimal. */
static void show(Codec *c, const char *name, const Type *type, uint64_t raw) {
    uint64_t half = UINT64_C(1) << (8 * type->size - 1);
    start(c, name, "{\"type\":\"");
    print(c->out, "%s\",", type->name);
    if (type->kind == ADDRESS)
        for (unsigned i = 0; i < 6; i++)
            print(c->out, "%s%u%s", i > 0 ? "." : "\"value\":\"", (unsigned)(raw >> 8 * i & 255),
                  i < 5 ? "" : "\"}");
    else if (type->kind == REAL)
        print(c->out, "\"bits\":\"0x%0*" PRIx64 "\"}", (int)type->size * 2, raw);
    else if (type->kind == SIGNED && raw >= half)
        print(c->out, "\"value\":\"-%" PRIu64 "\"}", half - (raw - half));
    else
        print(c->out, "\"value\":\"%" PRIu64 "\"}", raw);
}

static bool read_net_id(Json p, uint64_t *raw) {
    for (int i = 0; i < 6; i++) {
        size_t digits = strspn(p, DIGITS);
        unsigned long part = digits > 0 && digits < 4 ? strtoul(p, NULL, 10) : 256;
        p += digits;
        if (part > 255 || *p++ != (i < 5 ? '.' : '"')) return false;
        *raw |= (uint64_t)part << 8 * i;
    }
    return true;
}

static bool read_typed(Json v, const Type *type, uint64_t *raw) {
    bool real = type->kind == REAL;
    uint64_t largest = UINT64_MAX >> (64 - 8 * type->size);
    Json text = member(v, real ? "bits" : "value"), named = member(v, "type");
    if (!text || *text++ != '"' || (named && !string_is(named, type->name))) return false;
    if (type->kind == ADDRESS) return read_net_id(text, raw);
    bool negative = *text == '-';
    Json digits = text + (real ? 2 : negative);
    char *end = NULL;
    errno = 0;
    *raw = strtoull(digits, &end, real ? 16 : 10);
    if (real)
        return strncmp(text, "0x", 2) == 0 && *end == '"' && strspn(digits, HEX) == 2 * type->size;
    if (type->kind == SIGNED) largest = largest / 2 + negative;
    /* Reject a plus sign, leading zeros and a negative zero. */
    if (errno != 0 || !isdigit((unsigned char)*digits) || *end != '"' || *raw > largest
        || (*digits == '0' && (negative || end != digits + 1))
        || (negative && type->kind != SIGNED))
        return false;
    *raw = negative ? 0 - *raw : *raw;
    return true;
}

static uint64_t want(Codec *c, const char *name, const Type *type) {
    uint64_t raw = 0;
    if (!read_typed(field(c, name), type, &raw)) fail(c, "out-of-range", here(c));
    return raw;
}

static uint64_t number(Codec *c, const char *name, const Type *type) {
    uint64_t raw = c->encoding ? want(c, name, type) : get(c, type->size);
    if (c->encoding) put(c, type->size, raw);
    if (!c->encoding && !c->fault) show(c, name, type, raw);
    return raw;
}

/* The number of the bytes or items that follow, which the value omits. */
static uint64_t counter(Codec *c, uint64_t counted) {
    if (!c->encoding) return get(c, 4);
    put(c, 4, counted);
    return counted;
}

/* Bytes up to the end of the stream; if `counted`, after their length. */
static void bytes(Codec *c, const char *name, bool counted) {
    size_t at = here(c);
    uint64_t length = counted ? counter(c, 0) : left(c);
    if (c->encoding) {
        if (!read_hex(member(field(c, name), "hex"), c->out)) fail(c, "mismatch", at);
        if (counted) set_u32(c->out, at, c->out->size - at - 4);
        return;
    }
    if (length != left(c)) fail(c, length > left(c) ? "truncated" : "trailing", c->at);
    start(c, name, "{\"type\":\"BYTES\",\"hex\":\"");
    print_hex(c->out, c->in + c->at, left(c), " ");
    print(c->out, "\"}");
    c->at = c->end;
}

/* `for (List l = open_list(...); more(c, &l);)` iterates over a list. In the loop,
 * an item is read or written as a field without a name. */
typedef struct {
    Json outer, item;
    size_t count;
} List;

static List open_list(Codec *c, const char *name, size_t count) {
    Json list = field(c, name);
    List l = { c->value, c->encoding ? first_item(list) : NULL, count };
    if (c->encoding && (!list || *list != '[')) fail(c, "mismatch", here(c));
    if (!c->encoding) start(c, name, "[");
    return l;
}

static bool more(Codec *c, List *l) {
    bool another = !c->fault && (c->encoding ? l->item != NULL : l->count-- > 0);
    if (another && c->encoding) {
        c->value = l->item;
        l->item = next_item(l->item);
    } else if (!another) {
        c->value = l->outer;
        if (!c->encoding) print(c->out, "]");
    }
    return another;
}

/* UNS32 items after their number. A number of more items than the stream contains
 * is rejected before any item is read. */
static void counted_numbers(Codec *c, const char *name) {
    size_t at = here(c);
    uint64_t count = counter(c, c->encoding ? list_length(field(c, name)) : 0);
    if (!c->encoding && count > left(c) / 4) fail(c, "too-many", at);
    for (List l = open_list(c, name, (size_t)count); more(c, &l);) number(c, NULL, UNS32);
}

/* A REQUEST ends with a NUL, after which only NULs may follow; in an OPEN_REQUEST,
 * this NUL may be missing. A REPLY ends at its first NUL or at the end of its room,
 * and any bytes may follow the NUL. FILLED is a REPLY of 32 bytes, padded with NULs.
 * A PREFIX ends with a NUL, and other fields follow. A PART has no NUL. */
typedef enum { REQUEST, OPEN_REQUEST, REPLY, FILLED, PREFIX, PART } Rule;

static void read_text(Codec *c, const char *name, Rule rule, size_t room) {
    if (c->fault) return;
    const unsigned char *text = c->in + c->at;
    const unsigned char *nul = room > 0 ? memchr(text, 0, room) : NULL;
    size_t length = nul ? (size_t)(nul - text) : room;
    size_t after = nul ? length + 1 : room, zeros = room;
    while (zeros > after && text[zeros - 1] == 0) zeros--;
    if (!nul && rule == REQUEST && room > 0) fail(c, "missing-nul", c->at);
    if (zeros > after && (rule == REQUEST || rule == OPEN_REQUEST))
        fail(c, "trailing", c->at + after);
    start(c, name, "{\"type\":\"STRING\",\"hex\":\"");
    print_hex(c->out, text, length, " ");
    if (after < room && !(rule == FILLED && zeros == after)) {
        print(c->out, "\",\"tail\":\"");
        print_hex(c->out, text + after, room - after, " ");
    }
    print(c->out, nul ? "\"}" : "\",\"open\":true}");
    c->at += room;
}

/* Writes a text as it was read, including `tail` and `open`, so that no bytes are
 * lost. A text without `tail` and `open` is canonical: it ends with one NUL. */
static void write_text(Codec *c, const char *name, Rule rule) {
    Json v = field(c, name), type = member(v, "type"), tail = member(v, "tail");
    bool open = member(v, "open") && *member(v, "open") == 't';
    size_t at = here(c);
    bool good = (!type || string_is(type, "STRING")) && read_hex(member(v, "hex"), c->out);
    good = good && (c->out->size == at || !memchr(c->out->data + at, 0, c->out->size - at));
    if (!open) append_byte(c->out, 0);
    good = good && (!tail || (!open && read_hex(tail, c->out)));
    while (rule == FILLED && !open && !tail && c->out->size < at + 32) append_byte(c->out, 0);
    if (!good || (rule == PREFIX && (open || tail)) || (rule == PART && !open)
        || (rule == FILLED && c->out->size != at + 32))
        fail(c, "mismatch", at);
}

/* The elements of a value, with the type and the dimensions of the context, which
 * does not contain the size of a STRING. All STRINGs of an array have the same size
 * of at least one byte; a single STRING has all remaining bytes, possibly none. */
static void elements(Codec *c, const char *name) {
    bool string = c->type->kind == TEXT;
    size_t room = c->type->size, at = here(c), of = 0;
    if (string) room = c->encoding || c->count == 0 ? 0 : (size_t)(left(c) / c->count);
    if (c->encoding && list_length(field(c, name)) != c->count) fail(c, "mismatch", at);
    if (!c->encoding && (c->count * room != left(c) || (room == 0 && c->count > 1)))
        fail(c, "bad-length", at);
    for (List l = open_list(c, name, (size_t)c->count); more(c, &l);) {
        if (!string) number(c, NULL, c->type);
        if (string && !c->encoding) read_text(c, NULL, REPLY, room);
        if (!string || !c->encoding) continue;
        write_text(c, NULL, REPLY);
        if (of++ == 0) room = c->out->size - at;
        if (c->out->size - at != of * room) fail(c, "mismatch", at);
    }
}

typedef struct {
    enum { END, NUMBER, LENGTH, DATA, LIST, STRING, ELEMENTS, CONTENT, BYTES, MAYBE, SPECIAL } form;
    const char *name;
    const Type *type;
    Rule rule;
    size_t least, most;
    void (*special)(Codec *);
} Field;

#define N(t, n) { .form = NUMBER, .name = n, .type = t }
#define U32(n) N(UNS32, n)
#define F(f, n) { .form = f, .name = n }
#define S(n, r, from, to) { .form = STRING, .name = n, .rule = r, .least = from, .most = to }
/* The remaining fields may be missing if the preceding number is at least `from`. */
#define OPTIONAL(from) { .form = MAYBE, .least = from }
#define OWN(function) ROW({ .form = SPECIAL, .special = function })
#define LAST { .form = END }
#define ROW(...) (const Field[]) { __VA_ARGS__, LAST }

/* A text has the rest of the stream, except with the rules FILLED and PREFIX. */
static void read_text_field(Codec *c, const Field *f) {
    size_t room = f->rule == FILLED ? f->most : left(c);
    const unsigned char *nul = left(c) > 0 ? memchr(c->in + c->at, 0, left(c)) : NULL;
    if (left(c) < f->least) fail(c, f->rule == REQUEST ? "missing-nul" : "truncated", c->at);
    if (f->rule == PREFIX) room = nul ? (size_t)(nul - (c->in + c->at)) + 1 : SIZE_MAX;
    if (room > f->most) fail(c, f->rule == PREFIX && !nul ? "missing-nul" : "too-long", c->at);
    read_text(c, f->name, f->rule, room);
}

static bool missing(const Codec *c, const Field *f) {
    while (c->encoding && f->form != END && !field(c, f->name)) f++;
    return c->encoding ? f->form == END : left(c) == 0;
}

static void fields(Codec *c, const Field *f) {
    for (uint64_t last = 0; f->form != END; f++) {
        switch (f->form) {
        case NUMBER:
            last = number(c, f->name, f->type);
            if (last < f->least) fail(c, "out-of-range", here(c));
            break;
        case MAYBE:
            if (last >= f->least && missing(c, f + 1)) return;
            break;
        case BYTES:
            if (!c->encoding && left(c) < f->least) fail(c, "truncated", c->at);
            bytes(c, f->name, false);
            break;
        case STRING: c->encoding ? write_text(c, f->name, f->rule) : read_text_field(c, f); break;
        case LENGTH: c->framed ? counter(c, 0) : number(c, f->name, UNS32); break;
        case DATA: bytes(c, f->name, true); break;
        case LIST: counted_numbers(c, f->name); break;
        case ELEMENTS: elements(c, f->name); break;
        case CONTENT: c->type ? elements(c, f->name) : bytes(c, f->name, false); break;
        case SPECIAL: f->special(c); break;
        case END: break;
        }
    }
}

static void record(Codec *c, const char *name, const Field *f) {
    Json outer = c->value;
    c->value = c->encoding ? field(c, name) : NULL;
    if (!c->encoding) start(c, name, "{");
    fields(c, f);
    if (!c->encoding) print(c->out, "}");
    c->value = outer;
}

/* ---- Streams that need functions of their own --------------------------- */

#define ADDRESSED U32("index_group"), U32("index_offset")

static const Field OBJECT_DESCRIPTOR[]
    = { U32("id"), U32("size"), N(UNS16, "write_access"), N(UNS16, "not_assigned"), ADDRESSED,
        S("name", FILLED, 32, 32), S("type", FILLED, 32, 32), LAST };

static void object_descriptors(Codec *c) {
    if (!c->encoding && (left(c) == 0 || left(c) % 84 != 0))
        fail(c, "bad-length", left(c) / 84 * 84);
    List l = open_list(c, "descriptors", left(c) / 84);
    while (more(c, &l)) record(c, NULL, OBJECT_DESCRIPTOR);
}

/* The width is not documented: the length of the stream or the type determines it. */
static void element_length(Codec *c) {
    Json named = member(field(c, "length"), "type");
    const Type *type = UNS32;
    if (c->encoding ? string_is(named, "UNS08") : left(c) == 1) type = UNS08;
    if (c->encoding ? string_is(named, "UNS16") : left(c) == 2) type = UNS16;
    number(c, "length", type);
}

/* A piece of a variable's name: `V.` and a word, or only a word. The same loop finds
 * the end of the word when decoding, and an invalid character when encoding. */
static void path_piece(Codec *c, const char *name, const char *prefix) {
    size_t at = here(c), from = strlen(prefix), length = from;
    if (c->encoding) write_text(c, name, PART);
    size_t room = c->encoding ? c->out->size - at : left(c);
    if (room <= from) fail(c, "truncated", at);
    if (c->fault) return;
    const unsigned char *piece = c->encoding ? c->out->data + at : c->in + at;
    while (length < room && piece[length] != 0 && !strchr(".[]", piece[length])) length++;
    if (memcmp(piece, prefix, from) != 0 || length == from || (c->encoding && length < room))
        fail(c, "unexpected", at);
    if (!c->encoding) read_text(c, name, PART, length);
}

static bool next_is(const Codec *c, char expected) {
    return !c->fault && left(c) > 0 && c->in[c->at] == expected;
}

static void path_index(Codec *c) {
    if (c->encoding) {
        print(c->out, "[%" PRIu64 "]", want(c, NULL, UNS32));
        return;
    }
    uint64_t index = 0;
    size_t at = ++c->at;
    for (; left(c) > 0 && isdigit(c->in[c->at]); c->at++)
        if (index < UINT32_MAX) index = index * 10 + (uint64_t)(c->in[c->at] - '0');
    if (c->at == at || !next_is(c, ']'))
        fail(c, left(c) == 0 ? "truncated" : "unexpected", c->at);
    else if (index >= UINT32_MAX)
        fail(c, "out-of-range", at);
    else
        c->at++;
    show(c, NULL, UNS32, index);
}

static void path_part(Codec *c) {
    if (c->encoding)
        append_byte(c->out, '.');
    else if (next_is(c, '.'))
        c->at++;
    else
        fail(c, "unexpected", c->at);
    path_piece(c, "name", "");
    List indices = open_list(c, "indices", next_is(c, '[') ? SIZE_MAX : 0);
    while (more(c, &indices)) {
        path_index(c);
        if (!next_is(c, '[')) indices.count = 0;
    }
}

/* The numbers of parts and indices are known only after reading them. */
static void variable_path(Codec *c) {
    path_piece(c, "kind", "V.");
    for (List parts = open_list(c, "parts", SIZE_MAX); more(c, &parts);) {
        record(c, NULL, OWN(path_part));
        if (!c->encoding && left(c) == 0) parts.count = 0;
    }
}

/* A part of an address: added when decoding, and compared, if given, when encoding. */
static void derived(Codec *c, const char *name, const char *word) {
    if (!c->encoding) {
        start(c, name, "{\"type\":\"NAME\",\"value\":\"");
        print(c->out, "%s\"}", word);
    } else if (field(c, name) && !string_is(member(field(c, name), "value"), word)) {
        fail(c, "mismatch", 0);
    }
}

static void index_group(Codec *c) {
    static const char *const tables[] = { "channel", "axis" };
    static const char *const classes[] = { "position-controller", "interpolator", "decoder",
                                           "hld", "path-preparation", "spindle" };
    static const char *const attributes[] = { "content", "name", "type", "length", "unit",
                                              "write-flag", "object-address" };
    uint64_t group = number(c, "index_group", UNS32);
    uint64_t table = group >> 8 & 15, class = group >> 12 & 15, access = group >> 16 & 15;
    bool logical = group >> 20 == 1, com = table == 1 || table == 2;
    if (c->based && (group < c->base || group - c->base > 255 || group >> 8 != c->base >> 8))
        fail(c, "out-of-range", 0);
    /* Only COM has object access, only SDA and GEO have classes, and spindles have
     * no logical address. Any other group has only its number. */
    bool known = group >> 20 <= 1 && (com ? class == 0 && (access == 2 || access == 3)
                                          : table >= 3 && table <= 9 && class <= 5 && access == 2);
    if (c->fault || !known || (!com && class == 5 && logical)) return;
    derived(c, "task", com ? "COM" : "SDA/GEO");
    derived(c, "access", access == 2 ? "element" : "object");
    derived(c, "addressing", logical ? "logical" : "index");
    derived(c, com ? "table" : "class", com ? tables[table - 1] : classes[class]);
    if (!com) derived(c, "attribute", attributes[table - 3]);
    if (!c->encoding)
        show(c, "instance", UNS08, group & 255);
    else if (field(c, "instance") && want(c, "instance", UNS08) != (group & 255))
        fail(c, "mismatch", 0);
}

static void index_offset(Codec *c) {
    if (c->encoding) {
        uint64_t axis = want(c, "axis", UNS16), element = want(c, "element", UNS16);
        if (element >= c->stride) fail(c, "out-of-range", 0);
        put(c, 4, axis * c->stride + element);
        return;
    }
    uint64_t offset = get(c, 4);
    if (offset / c->stride > UINT16_MAX) fail(c, "out-of-range", 0);
    show(c, "axis", UNS16, offset / c->stride);
    show(c, "element", UNS16, offset % c->stride);
}

/* ---- The streams, with their fields as in the table of the vectors ------ */

#define DESCRIBED U32("handle"), U32("type"), U32("access"), U32("size"), F(LIST, "dimensions")

static const Field AMS_TCP_HEADER[] = { N(UNS16, "reserved"), F(LENGTH, "length"), LAST };
static const Field AMS_HEADER[]
    = { N(NETID, "target_net_id"), N(UNS16, "target_port"), N(NETID, "source_net_id"),
        N(UNS16, "source_port"), N(UNS16, "command"), N(UNS16, "state_flags"),
        F(LENGTH, "data_length"), U32("error"), U32("invoke_id"), LAST };

static void ams_frame(Codec *c);

static const struct Stream {
    const char *name;
    const Field *fields;
    size_t most; /* maximum length in bytes; 0: no limit */
} STREAMS[] = {
    { "read-request", ROW(ADDRESSED, U32("length")), 0 },
    { "read-reply", ROW(U32("result"), OPTIONAL(1), F(DATA, "data")), 0 },
    { "write-request", ROW(ADDRESSED, F(DATA, "data")), 0 },
    { "write-reply", ROW(U32("result")), 0 },
    { "read-write-request", ROW(ADDRESSED, U32("read_length"), F(DATA, "data")), 0 },
    { "read-write-reply", ROW(U32("result"), OPTIONAL(1), F(DATA, "data")), 0 },
    { "ams-tcp-header", AMS_TCP_HEADER, 0 },
    { "ams-header", AMS_HEADER, 0 },
    { "ams-frame", OWN(ams_frame), 0 },
    { "object-count", ROW(U32("count")), 0 },
    { "object-descriptor", OBJECT_DESCRIPTOR, 0 },
    { "object-descriptors", OWN(object_descriptors), 0 },
    { "content", ROW(F(CONTENT, "content")), 4194304 },
    { "object-address-query", ROW(U32("channel"), U32("axis")), 0 },
    { "object-address", ROW(ADDRESSED), 0 },
    { "element-count", ROW(U32("count")), 0 },
    { "element-text", ROW(S("text", REPLY, 0, 256)), 0 },
    { "element-length", OWN(element_length), 0 },
    { "element-write-flag", ROW(N(BOOLEAN, "flag")), 0 },
    { "dynamic-count", ROW(U32("count")), 0 },
    { "dynamic-index", ROW({ .form = NUMBER, .name = "index", .type = UNS32, .least = 1 }), 0 },
    { "dynamic-name", ROW(S("name", REPLY, 1, 96)), 0 },
    { "dynamic-name-request", ROW(S("name", OPEN_REQUEST, 1, 96)), 0 },
    { "dynamic-value", ROW(N(REAL64, "value")), 0 },
    { "variable-kind", ROW(S("kind", REQUEST, 0, 256)), 0 },
    { "variable-count", ROW(U32("count")), 0 },
    { "variable-index-kind", ROW(U32("index"), S("kind", REQUEST, 1, 256)), 0 },
    { "variable-description", ROW(DESCRIBED, S("name", REPLY, 1, 256)), 2048 },
    { "variable-description-by-name", ROW(DESCRIBED), 2048 },
    { "variable-name", ROW(S("name", REQUEST, 1, 256)), 0 },
    { "variable-handle", ROW(U32("handle")), 0 },
    { "variable-handle-read", ROW(U32("handle"), F(LIST, "indices")), 2048 },
    { "variable-value", ROW(F(ELEMENTS, "value")), 2048 },
    { "variable-handle-write", ROW(U32("handle"), F(LIST, "indices"), F(ELEMENTS, "value")), 2048 },
    { "variable-name-write", ROW(S("name", PREFIX, 0, 256), F(ELEMENTS, "value")), 2048 },
    { "variable-extended-description",
      ROW(OPTIONAL(0), U32("synchronisation"), U32("validity")), 0 },
    { "variable-path", OWN(variable_path), 255 },
    { "program-stream", ROW({ .form = BYTES, .name = "data", .least = 1 }), 992 },
    { "index-group", OWN(index_group), 0 },
    { "index-offset", OWN(index_offset), 0 },
};

/* State flags and command of the first six streams, and their names in a frame. */
static const struct {
    uint32_t flags_and_command;
    const char *name;
} SERVICES[] = {
    { 0x40002, "read_request" },       { 0x50002, "read_reply" },
    { 0x40003, "write_request" },      { 0x50003, "write_reply" },
    { 0x40009, "read_write_request" }, { 0x50009, "read_write_reply" },
};

static void ams_frame(Codec *c) {
    c->framed = true;
    record(c, "ams_tcp_header", AMS_TCP_HEADER);
    record(c, "ams_header", AMS_HEADER);
    if (c->fault) return;
    const unsigned char *head = c->encoding ? c->out->data : c->in;
    size_t i = 0;
    while (i < COUNT_OF(SERVICES) && SERVICES[i].flags_and_command != get_u32(head + 22)) i++;
    bool known = i < COUNT_OF(SERVICES);
    const char *name = known ? SERVICES[i].name : "data";
    if (get_u32(head) % 65536 != 0) fail(c, "mismatch", 0);
    if (!c->encoding && (get_u32(head + 2) != c->end - 6 || get_u32(head + 26) != left(c)))
        fail(c, "mismatch", get_u32(head + 26) != left(c) ? 26 : 2);
    bool none = c->encoding ? !field(c, name) : left(c) == 0;
    if (get_u32(head + 30) == 0 || !none) /* an error reply may have no data */
        known ? record(c, name, STREAMS[i].fields) : bytes(c, name, false);
    if (c->encoding) {
        set_u32(c->out, 2, c->out->size - 6);
        set_u32(c->out, 26, c->out->size - 38);
    }
}

static bool decode(Codec *c, const struct Stream *stream, const Bytes *in, Bytes *out) {
    c->encoding = false;
    c->in = in->size > 0 ? in->data : (const unsigned char *)"";
    c->at = 0;
    c->end = in->size;
    c->out = out;
    if (stream->most > 0 && in->size > stream->most) fail(c, "too-long", stream->most);
    print(out, "{");
    if (!c->fault) fields(c, stream->fields);
    if (left(c) > 0) fail(c, "trailing", c->at);
    print(out, "}");
    return !c->fault;
}

/* Decodes the encoded bytes again, so that only the decoder has to check the
 * limits. */
static bool encode(Codec *c, const struct Stream *stream, Json value, Bytes *out) {
    Bytes again = { NULL, 0, 0 };
    c->encoding = true;
    c->value = value;
    c->out = out;
    fields(c, stream->fields);
    if (!c->fault) decode(c, stream, out, &again);
    free(again.data);
    return !c->fault;
}

/* ---- The protocol ------------------------------------------------------- */

static bool answer_hello(Bytes *answer) {
    print(answer, "{\"protocol\":1,\"testee\":{\"name\":\"c-example\",\"version\":\"1.0\","
                  "\"language\":\"C\"},\"capabilities\":{\"ops\":[\"decode\",\"encode\"],"
                  "\"editions\":[\"en-1.05\",\"de-1.051\"],\"streams\":[");
    for (size_t i = 0; i < COUNT_OF(STREAMS); i++)
        print(answer, i > 0 ? ",\"%s\"" : "\"%s\"", STREAMS[i].name);
    print(answer, "]}}");
    return true;
}

/* Reads the context; returns false if this codec does not support it. */
static bool read_context(Codec *c, const struct Stream *stream, Json context) {
    Json type = member(context, "type"), stride = member(context, "stride");
    Json base = member(context, "base");
    for (size_t i = 0; i < COUNT_OF(TYPES) - 1; i++)
        if (string_is(type, TYPES[i].name)) c->type = &TYPES[i];
    c->count = 1;
    /* Limit the count to more items than any stream has, so that no product overflows. */
    for (Json d = first_item(member(context, "dimensions")); d; d = next_item(d)) {
        uint64_t size = read_number(d);
        c->count = size > UINT32_MAX || c->count * size > UINT32_MAX ? UINT32_MAX : c->count * size;
    }
    c->stride = read_number(stride);
    c->based = base != NULL;
    c->base = read_number(base);
    bool typed = type != NULL;
    for (const Field *f = stream->fields; f->form != END; f++)
        typed = typed || f->form == ELEMENTS;
    if (!c->type && typed) return false;
    return stream->fields->special != index_offset || c->stride == 0x10000 || c->stride == 0x1000;
}

static void answer_case(Json request, Bytes *answer) {
    Json op = member(request, "op"), name = member(request, "stream");
    Json edition = member(request, "edition"), context = member(request, "context");
    bool known = string_is(edition, "en-1.05") || string_is(edition, "de-1.051");
    bool decoding = string_is(op, "decode");
    Json given = member(request, decoding ? "hex" : "value");
    const struct Stream *stream = NULL;
    Codec c = { .encoding = false };
    Bytes in = { NULL, 0, 0 }, out = { NULL, 0, 0 };

    for (size_t i = 0; i < COUNT_OF(STREAMS); i++)
        if (string_is(name, STREAMS[i].name)) stream = &STREAMS[i];
    const char *unsupported = !decoding && !string_is(op, "encode") ? "op"
        : !stream ? "stream" : !known ? "edition"
        : !read_context(&c, stream, context) ? "context" : NULL;
    if (unsupported) {
        print(answer, "\"unsupported\":{\"what\":\"%s\"}}", unsupported);
    } else if (decoding ? !read_hex(given, &in) : !given) {
        print(answer, "\"error\":{\"message\":\"neither hex nor value\"}}");
    } else if (decoding ? !decode(&c, stream, &in, &out) : !encode(&c, stream, given, &out)) {
        print(answer, "\"reject\":{\"class\":\"%s\",\"at\":%zu}}", c.fault, c.fault_at);
    } else if (decoding) {
        print(answer, "\"ok\":{\"value\":");
        append(answer, out.data, out.size);
        print(answer, "}}");
    } else {
        print(answer, "\"ok\":{\"hex\":\"");
        print_hex(answer, out.data, out.size, "");
        print(answer, "\"}}");
    }
    free(in.data);
    free(out.data);
}

/* Answers a line; returns false after `bye`. */
static bool answer_line(const Bytes *line, Bytes *answer) {
    const char *text = (const char *)line->data;
    bool whole = line->size <= LONGEST_LINE;
    Json request = skip_space(text);
    Json end = whole && *request == '{' ? skip_value(request, 0) : NULL;
    if (!end || skip_space(end) != text + line->size - 1) request = NULL;
    Json cmd = member(request, "cmd"), seq = member(request, "seq");
    size_t digits = seq ? strspn(seq, DIGITS) : 0;
    if (string_is(cmd, "bye")) return false;
    if (string_is(cmd, "hello")) return answer_hello(answer);
    /* Repeat the digits of the number unchanged. */
    print(answer, "{\"seq\":");
    append(answer, digits > 0 ? seq : "null", digits > 0 ? digits : 4);
    print(answer, ",");
    if (string_is(cmd, "case"))
        answer_case(request, answer);
    else
        print(answer, "\"error\":{\"message\":\"%s\"}}",
              !whole ? "line too long" : request ? "no such cmd" : "no JSON object");
    return true;
}

/* Reads a line and replaces its line end by a NUL. Stores only the beginning of a
 * line that is too long. Returns false at the end of the input. */
static bool read_line(Bytes *line) {
    int c = getchar();
    if (c == EOF) return false;
    for (line->size = 0; c != EOF && c != '\n'; c = getchar())
        if (line->size <= LONGEST_LINE) append_byte(line, (unsigned)c);
    append_byte(line, 0);
    return true;
}

int main(void) {
    Bytes line = { NULL, 0, 0 }, answer = { NULL, 0, 0 };
    while (read_line(&line)) {
        answer.size = 0;
        if (!answer_line(&line, &answer)) break;
        append_byte(&answer, '\n');
        fwrite(answer.data, 1, answer.size, stdout);
        /* Flush the buffer, because the suite waits for the answer. */
        if (fflush(stdout) != 0) return EXIT_FAILURE;
    }
    free(line.data);
    free(answer.data);
    return EXIT_SUCCESS;
}
