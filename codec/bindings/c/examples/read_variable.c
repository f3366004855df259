/*
 * Reads a variable by its name over plain sockets, without an ADS library:
 *
 *     read_variable 127.0.0.1 48898 127.0.0.1.1.1 1 V.E.matrix
 *
 * The program reads the description of the variable, which contains its type, and then the value. It only needs
 * POSIX and C11.
 */
#include "ads_cnc.h"

#include <netdb.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

static uint8_t sent[4096], received[4096];

static void die(const char *what) {
    fprintf(stderr, "%s\n", what);
    exit(1);
}

static void fail(const AdsCncError *e) {
    fprintf(stderr, "%.*s: %.*s at offset %u: %.*s, expected %u, found %u\n", (int)e->subject.length,
            (const char *)e->subject.data, (int)e->name.length, (const char *)e->name.data, e->offset,
            (int)e->text.length, (const char *)e->text.data, e->expected, e->found);
    exit(1);
}

static int dial(const char *host, const char *port) {
    struct addrinfo wanted = {0}, *found = NULL;
    wanted.ai_socktype = SOCK_STREAM;
    if (getaddrinfo(host, port, &wanted, &found) != 0) die("no such host");
    int connection = socket(found->ai_family, found->ai_socktype, 0);
    struct timeval timeout = {5, 0};
    setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    if (connection < 0 || connect(connection, found->ai_addr, found->ai_addrlen) != 0) die("no connection");
    freeaddrinfo(found);
    return connection;
}

/* Sends a call in a frame and returns the data of the reply, in `received`. */
static AdsCncBytes ask(int connection, const uint8_t net_id[6], const AdsCncCall *call) {
    AdsCncFrame frame = {0};
    AdsCncError error;
    uint8_t payload[2048];
    uint32_t length = 0, used = 0, there = 0;
    memcpy(frame.target.net_id, net_id, 6);
    frame.target.port = (uint16_t)call->port;
    memcpy(frame.source.net_id, (const uint8_t[6]){127, 0, 0, 1, 1, 2}, 6);
    frame.source.port = 0x8001;
    frame.command = call->command;
    frame.state_flags = ADS_CNC_REQUEST;
    frame.invoke_id = 1;
    if (!ads_cnc_call_write(call, payload, sizeof payload, &length, &error)) fail(&error);
    frame.data = (AdsCncBytes){payload, length};
    if (!ads_cnc_frame_write(&frame, sent, sizeof sent, &length, &error)) fail(&error);
    if (write(connection, sent, length) != (ssize_t)length) die("the request was not sent completely");

    while (used == 0) {
        ssize_t more = read(connection, received + there, sizeof received - there);
        if (more <= 0) die("no reply");
        there += (uint32_t)more;
        if (!ads_cnc_frame_read(received, there, sizeof received, &frame, &used, &error)) fail(&error);
    }
    if (frame.error != 0) {
        fprintf(stderr, "AMS error 0x%x\n", frame.error);
        exit(1);
    }
    /* The data of the frame is a stream: result, length, data. */
    AdsCncField fields[3];
    uint32_t count = 0, reply = ads_cnc_stream("read-write-reply", 16);
    if (!ads_cnc_decode(reply, frame.data.data, frame.data.length, fields, 3, &count, &error))
        fail(&error);
    if (fields[0].number != 0) {
        fprintf(stderr, "ADS error 0x%x\n", fields[0].number);
        exit(1);
    }
    return (AdsCncBytes){frame.data.data + fields[2].offset, fields[2].length};
}

static void show(const AdsCncType *type, const uint8_t *at) {
    uint64_t bits = 0;
    for (uint32_t byte = 0; byte < type->size; byte++) bits |= (uint64_t)at[byte] << 8 * byte;
    uint32_t unused = 64 - 8 * type->size;
    double number;
    float single;
    switch (type->kind) {
    case ADS_CNC_TYPE_FLOAT:
        if (type->size == 4) {
            uint32_t half = (uint32_t)bits;
            memcpy(&single, &half, 4);
            number = (double)single;
        } else {
            memcpy(&number, &bits, 8);
        }
        printf(" %g", number);
        break;
    case ADS_CNC_TYPE_SIGNED:
        printf(" %lld", (long long)(int64_t)(bits << unused) >> unused);
        break;
    default:
        printf(" %llu", (unsigned long long)bits);
    }
}

int main(int argc, char **argv) {
    unsigned part[6];
    if (argc != 6 ||
        sscanf(argv[3], "%u.%u.%u.%u.%u.%u", part, part + 1, part + 2, part + 3, part + 4, part + 5) != 6)
        die("usage: read_variable HOST PORT NET-ID CHANNEL NAME");
    if (ads_cnc_abi() != ADS_CNC_ABI) die("the library and ads_cnc.h have different ABI numbers");
    uint8_t net_id[6], data[512];
    for (int at = 0; at < 6; at++) net_id[at] = (uint8_t)part[at];

    /* Names are CP1252 on the wire. */
    AdsCncError error;
    AdsCncRequest request = {0};
    uint8_t name[256];
    uint32_t length = 0;
    if (!ads_cnc_text_from_utf8((const uint8_t *)argv[5], (uint32_t)strlen(argv[5]), name, sizeof name,
                                &length, &error))
        fail(&error);
    request.channel = (uint32_t)strtoul(argv[4], NULL, 10);
    request.name = (AdsCncBytes){name, length};

    AdsCncCall call;
    AdsCncField fields[512];
    uint32_t count = 0, code = 0;
    int connection = dial(argv[1], argv[2]);
    request.function = ads_cnc_function("DescribeByName", 14);
    if (!ads_cnc_encode(&request, data, sizeof data, &call, &error)) fail(&error);
    AdsCncBytes reply = ask(connection, net_id, &call);
    if (!ads_cnc_decode_reply(&request, reply.data, reply.length, fields, 512, &count, &error))
        fail(&error);
    uint32_t type_field = ads_cnc_field(ads_cnc_stream("variable-description-by-name", 28), "type", 4);
    for (uint32_t at = 0; at < count; at++)
        if (fields[at].field == type_field) code = fields[at].number;
    AdsCncType type;
    for (uint32_t at = 0;; at++) {
        if (!ads_cnc_type(at, &type)) die("a type that is not documented");
        if (type.code == code) break;
    }

    request.function = ads_cnc_function("ReadByName", 10);
    if (!ads_cnc_encode(&request, data, sizeof data, &call, &error)) fail(&error);
    reply = ask(connection, net_id, &call);
    if (!ads_cnc_decode_reply(&request, reply.data, reply.length, fields, 512, &count, &error))
        fail(&error);
    const uint8_t *value = reply.data + fields[0].offset;
    printf("%s: %.*s", argv[5], (int)type.name.length, (const char *)type.name.data);
    if (type.kind == ADS_CNC_TYPE_TEXT) {
        uint8_t text[3 * 2048];
        if (!ads_cnc_text_to_utf8(value, fields[0].length, text, sizeof text, &length, &error))
            fail(&error);
        printf(" %.*s", (int)length, (const char *)text);
    } else {
        for (uint32_t at = 0; at + type.size <= fields[0].length; at += type.size) show(&type, value + at);
    }
    printf("\n");
    close(connection);
    return 0;
}
