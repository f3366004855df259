-- A dissector of AMS frames to and from a CNC, for Wireshark and tshark 4.0 or later. It shows the
-- function, the requirement, the effect and each field, all usable in display filters.
--
-- Printed by `ads-cnc wireshark`, version @VERSION@, from the tables of its codec. Copy this file into the
-- folder that Wireshark shows under Help > About > Folders > Personal Lua Plugins, or run:
--
--   tshark -X lua_script:ads_cnc.lua -r capture.pcapng -Y "ads_cnc.effect == \"Write\""
--
-- For a TCP port other than 48898, use Analyze > Decode As > ADS_CNC, or `tshark -d tcp.port==PORT,ads_cnc`.

local tables = @TABLES@

local streams = {}
for _, stream in ipairs(tables.streams) do streams[stream.name] = stream end

local cnc = Proto("ads_cnc", "CNC over ADS")
local function_field = ProtoField.string("ads_cnc.function", "Function")
local clause_field = ProtoField.string("ads_cnc.clause", "Requirement")
local effect_field = ProtoField.string("ads_cnc.effect", "Effect")
local stream_field = ProtoField.string("ads_cnc.stream", "Stream")
local fault_field = ProtoField.string("ads_cnc.fault", "Fault")
local all_fields = { function_field, clause_field, effect_field, stream_field, fault_field }

local NUMBERS = { UNS08 = ProtoField.uint8, BOOLEAN = ProtoField.uint8, UNS16 = ProtoField.uint16,
    UNS32 = ProtoField.uint32, unsigned = ProtoField.uint32 }
for _, stream in ipairs(tables.streams) do
    for _, field in ipairs(stream.fields) do
        local filter = ("ads_cnc.%s.%s"):format(stream.name, field.name):gsub("-", "_")
        if NUMBERS[field.type] then
            field.proto = NUMBERS[field.type](filter, field.name, base.DEC_HEX)
            field.is_number = true
        elseif field.type == "REAL64" and field.size.bytes == 8 then
            field.proto = ProtoField.double(filter, field.name)
            field.is_number = true
        elseif field.type == "STRING" then
            field.proto = ProtoField.string(filter, field.name)
            field.is_text = true
        else
            field.proto = ProtoField.bytes(filter, field.name)
        end
        all_fields[#all_fields + 1] = field.proto
    end
end
cnc.fields = all_fields

local function has_offset(offsets, offset)
    if offsets.kind == "one-of" then
        for _, one in ipairs(offsets.offsets) do if one == offset then return true end end
        return false
    elseif offsets.kind == "at-least" then
        return offset >= offsets.first
    end
    return math.floor(offset / 0x10000) >= offsets.first_axis and offset % 0x10000 == offsets.element
end

local function has_group(groups, group)
    for _, range in ipairs(groups) do
        if range[1] <= group and group <= range[2] then return true end
    end
    return false
end

-- The tasks GEO (551) and SDA (552) count as the same task, because the classes, such as the decoder, are
-- assumed to be available at both ports (ADR-10).
local function same_task(port, other) return (port == 553) == (other == 553) end

-- Copies the row of a function for a call with a mistake. The title of the copy states the mistake.
local function mistaken(row, mistake)
    local copy = { mistake = mistake }
    for key, value in pairs(row) do copy[key] = value end
    copy.title = row.title .. ", " .. mistake
    return copy
end

local function function_of(command, port, group, offset)
    for _, row in ipairs(tables.functions) do
        if same_task(row.port, port) and has_group(row.groups, group) and has_offset(row.offsets, offset) then
            if row.command == command then return row end
            -- A Read of the function's address may be a read of an element that has the same address, so it
            -- gets no function.
            if row.request ~= "content" and row.reply ~= "content" then
                if command == 2 then return nil end
                local copy = mistaken(row, "by a service other than " .. row.service)
                copy.request, copy.reply = nil, nil
                return copy
            end
        end
    end
    for _, row in ipairs(tables.functions) do
        if row.command == command and has_group(row.groups, group) and has_offset(row.offsets, offset) then
            return mistaken(row, ("at port %d instead of %d"):format(port, row.port))
        end
    end
end

-- The length in bytes of a field that starts at offset `at`; nil if the bytes end before the field ends.
local function length_of(field, range, at, count)
    local size, left = field.size, range:len() - at
    if size.kind == "items" then
        local length = size.each * count
        return length <= left and length or nil
    elseif size.bytes then
        return size.bytes <= left and size.bytes or nil
    elseif size.kind == "c-string-prefix" then
        local bytes = range(at):bytes()
        for place = 0, bytes:len() - 1 do
            if bytes:get_index(place) == 0 then return place + 1 end
        end
        return nil
    end
    return left
end

local function add_field(tree, field, range)
    local item
    if field.is_number then
        item = tree:add_le(field.proto, range)
    elseif field.is_text then
        item = tree:add_packet_field(field.proto, range, ENC_WINDOWS_1252)
    else
        item = tree:add(field.proto, range)
    end
    item:append_text(" (" .. field.clause .. ")")
end

local function walk(stream, range, tree)
    local at, count = 0, 0
    repeat
        for _, field in ipairs(stream.fields) do
            local length = length_of(field, range, at, count)
            local may_lack = field.size.kind == "optional-fixed" or field.size.kind == "fixed-on-success"
            if may_lack and at == range:len() then return end
            if not length then
                local fault = "the data ends inside the field " .. field.name
                tree:add(fault_field, at < range:len() and range(at) or range, fault)
                return
            end
            if field.size.kind == "items" then
                for place = at, at + length - 1, field.size.each do
                    add_field(tree, field, range(place, field.size.each))
                end
            elseif length > 0 then
                add_field(tree, field, range(at, length))
                if field.size.kind == "c-string" and range(at + length - 1, 1):uint() ~= 0 then
                    tree:add(fault_field, range(at), "no NUL after " .. field.name)
                end
                if field.type == "UNS32" then count = range(at, 4):le_uint() end
            end
            if length == 0 and field.size.kind == "c-string" and not field.size.optional then
                tree:add(fault_field, range, "no NUL after " .. field.name)
            end
            at = at + length
        end
    until not stream.repeats or at >= range:len()
    if at < range:len() then tree:add(fault_field, range(at), "bytes after the stream") end
end

-- `asked`: the function of each request, by connection and invoke ID, with which the first pass through the
-- capture finds the function of a reply. `found`: the function of each request and reply, by packet, for
-- later passes. Neither contains ReadDeviceInfo and ReadState, which `IDENTITIES` describes.
local asked, found = {}, {}

function cnc.init() asked, found = {}, {} end

local IDENTITIES = {
    [1] = { id = "ReadDeviceInfo", title = "device information", clause = "ADS-8", effect = "Query",
        reply = "device-info-reply" },
    [4] = { id = "ReadState", title = "device state", clause = "ADS-9", effect = "Query",
        reply = "device-state-reply" },
}
local NONE = { id = "none", title = "no function of a CNC", clause = "", effect = "unknown" }

local function show(frame, range, pinfo, tree, place)
    local to, from = frame(6, 2):le_uint(), frame(14, 2):le_uint()
    local command, flags, invoke_id = frame(16, 2):le_uint(), frame(18, 2):le_uint(), frame(28, 4):le_uint()
    local is_reply = flags % 2 == 1
    local port = is_reply and from or to
    if port < 551 or port > 553 then return end
    local target, source = frame(0, 8):bytes():tohex(), frame(8, 8):bytes():tohex()
    local client, device = is_reply and target or source, is_reply and source or target
    local ports = pinfo.src_port + pinfo.dst_port
    local key = table.concat({ client, device, ports, invoke_id }, "/")
    local visit = table.concat({ pinfo.number, key, is_reply and "reply" or "request" }, "/")

    local data, stream = frame:len() > 32 and frame(32) or nil, nil
    local row = found[visit] or IDENTITIES[command]
    local group, offset
    local is_call = command == 2 or command == 3 or command == 9
    if is_call and not is_reply and data and data:len() >= 8 then
        group, offset = data(0, 4):le_uint(), data(4, 4):le_uint()
    end
    if not row then
        row = is_reply and is_call and asked[key] or group and function_of(command, port, group, offset) or NONE
        if not is_reply then asked[key] = row end
        found[visit] = row
    end

    -- `start`: the offset at which the function's data starts, after the fields of the ADS service.
    local start, result = nil, 0
    if is_reply then
        start, stream = command == 3 and 4 or 8, row.reply
        result = data and data:len() >= 4 and data(0, 4):le_uint() or 0
        if IDENTITIES[command] then start = 0 end
    else
        start, stream = command == 9 and 16 or 12, row.request
    end
    local top = tree:add(cnc, range, ("CNC over ADS: %s, %s"):format(row.title, is_reply and "reply" or "request"))
    top:add(function_field, row.id):set_generated()
    top:add(clause_field, row.clause):set_generated()
    top:add(effect_field, row.effect):set_generated()
    if row.mistake and not is_reply then top:add(fault_field, row.mistake):set_generated() end
    local info = (is_reply and "< " or "> ") .. row.title
    if group then info = info .. (" 0x%X, 0x%X"):format(group, offset) end
    if result ~= 0 then info = info .. (": ADS error 0x%X"):format(result) end
    pinfo.cols.info:append(place == 1 and " | " .. info or "; " .. info)

    local layout = stream and streams[stream]
    if layout and result == 0 and data and data:len() > start then
        local part = data(start)
        local branch = top:add(stream_field, part, layout.name)
        branch:append_text(": " .. layout.title)
        walk(layout, part, branch)
    end
end

-- The dissector `ams` of Wireshark does not reassemble frames that TCP has split, so `cnc.dissector` does.
local ams = Dissector.get("ams")
local FRAME_MAX = 0x400000

function cnc.dissector(tvb, pinfo, tree)
    local place = 0
    local function length(part, _, offset)
        local left = part:len() - offset
        local frame = 6 + part(offset + 2, 4):le_uint()
        local is_header = part(offset, 2):uint() == 0 and frame >= 38 and frame <= FRAME_MAX
        return is_header and frame or left
    end
    local function dissect(frame)
        place = place + 1
        if frame:len() >= 38 then
            ams:call(frame(6):tvb(), pinfo, tree)
            show(frame(6), frame(), pinfo, tree, place)
        end
        return frame:len()
    end
    dissect_tcp_pdus(tvb, tree, 6, length, dissect)
end

DissectorTable.get("tcp.port"):add(48898, cnc)

local in_ethercat = Proto("ads_cnc_ethercat", "CNC over ADS in EtherCAT")

function in_ethercat.dissector(tvb, pinfo, tree)
    ams:call(tvb, pinfo, tree)
    if tvb:len() >= 32 then show(tvb(), tvb(), pinfo, tree, 1) end
end

DissectorTable.get("ecatf.type"):add(2, in_ethercat)
