// A client and a server. The client calls a function of type `Send`, which is the signature of
// AdsSyncReadWriteReqEx2 in Beckhoff's AdsLib; a real client passes that function. In this example, the client
// calls `cnc`, a small CNC that shows how to write a server.
#include "ads_cnc.h"

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

// Types with the same layout as those in AdsDef.h of AdsLib.
struct AmsNetId {
    uint8_t b[6];
};
struct AmsAddr {
    AmsNetId netId;
    uint16_t port;
};
using Send = long (*)(long port, const AmsAddr *address, uint32_t group, uint32_t offset,
                      uint32_t read_length, void *read, uint32_t write_length, const void *written,
                      uint32_t *bytes_read);

static std::string text(AdsCncBytes it) { return {reinterpret_cast<const char *>(it.data), it.length}; }
static AdsCncBytes bytes(const std::string &it) {
    return {reinterpret_cast<const uint8_t *>(it.data()), static_cast<uint32_t>(it.size())};
}
static uint32_t stream(const char *name) {
    return ads_cnc_stream(name, static_cast<uint32_t>(std::strlen(name)));
}
static uint32_t function(const char *name) {
    return ads_cnc_function(name, static_cast<uint32_t>(std::strlen(name)));
}

// A CNC with one variable, V.E.a, whose handle is 7. It has only the function HandleByName.
static long cnc(long, const AmsAddr *address, uint32_t group, uint32_t offset, uint32_t read_length,
                void *read, uint32_t write_length, const void *written, uint32_t *bytes_read) {
    const AdsCncBytes data{static_cast<const uint8_t *>(written), write_length};
    const AdsCncCall call{address->port, 9, group, offset, read_length, data};
    AdsCncRequest request;
    uint32_t indices[510], ads_error;
    if (!ads_cnc_dispatch(&call, indices, 510, &request, &ads_error, nullptr))
        return static_cast<long>(ads_error);
    const uint32_t invalid_size = 0x705, unknown = 0x710, unsupported = 0x701;
    if (request.function != function("HandleByName")) return unsupported;
    if (text(request.name) != "V.E.a") return unknown;
    AdsCncPart handle{0, 7, {nullptr, 0}};
    auto *room = static_cast<uint8_t *>(read);
    if (!ads_cnc_build(stream("variable-handle"), &handle, 1, room, read_length, bytes_read, nullptr))
        return invalid_size;
    return 0;
}

// Reads the handle of a variable.
static bool handle_of(Send send, const AmsAddr &cnc, const std::string &name, uint32_t &handle,
                      std::string &fault) {
    AdsCncRequest request{};
    request.function = function("HandleByName");
    request.channel = 1;
    request.name = bytes(name);
    uint8_t data[256];
    AdsCncCall call;
    AdsCncError error;
    AdsCncField field;
    uint32_t count, bytes_read = 0;
    auto failed = [&] {
        fault = text(error.subject) + ": " + text(error.name) + ": " + text(error.text);
        return false;
    };
    if (!ads_cnc_encode(&request, data, sizeof data, &call, &error)) return failed();
    std::vector<uint8_t> reply(call.read_length);
    AmsAddr address{cnc.netId, static_cast<uint16_t>(call.port)};
    long result = send(0, &address, call.index_group, call.index_offset, call.read_length, reply.data(),
                       call.data.length, call.data.data, &bytes_read);
    if (result != 0) {
        fault = "ADS error " + std::to_string(result);
        return false;
    }
    // Pass the received length, not the length of the buffer.
    if (!ads_cnc_decode_reply(&request, reply.data(), bytes_read, &field, 1, &count, &error))
        return failed();
    handle = field.number;
    return true;
}

int main() {
    if (ads_cnc_abi() != ADS_CNC_ABI) return 1;
    const AmsAddr address{{{192, 0, 2, 7, 1, 1}}, 0};
    for (const char *name : {"V.E.a", "V.E.b", "V.E.\n\0c"}) {
        uint32_t handle = 0;
        std::string fault;
        const std::string whole = name[4] == '\n' ? std::string(name, 7) : name;
        if (handle_of(cnc, address, whole, handle, fault)) std::printf("%s: handle %u\n", name, handle);
        else std::printf("%s\n", fault.c_str());
    }
    return 0;
}
