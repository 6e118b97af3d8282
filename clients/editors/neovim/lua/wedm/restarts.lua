-- What is done when the server ends, in every version of Neovim: "When the server ends" in docs/protocol.md. Who starts it again is in
-- client.lua and lsp/wedm.lua.

local M = {}

-- The version of the name space wedm/ that these files speak.
local protocol = 1
-- ms; a program that has not answered `initialize` by then is no server.
M.patience = 20000
-- ms
local pauses = { 0, 500, 1000, 2000, 4000 }
-- After a server that has lived this long, the count of ends in a row begins again.
local sound_life = 60000
local loop = vim.uv or vim.loop
-- What Neovim calls it when a server writes what is no message.
local babble = { INVALID_SERVER_MESSAGE = true, INVALID_SERVER_JSON = true, READ_ERROR = true }

-- Counts ends in a row: a function of the ms from the answer to `initialize` to the end (0: none came) that gives the pause before the
-- next start in ms, or nil when the server has ended too often. The next row begins then: whoever wants it starts it again.
function M.row()
    local ends = 0
    return function(life)
        ends = life >= sound_life and 1 or ends + 1
        local pause = pauses[ends]
        ends = pause and ends or 0
        return pause
    end
end

local after_life_of = M.row()
local servers = {} -- client id -> { program, kill, ready: when it had answered, asked: it was asked to end, babbled }

local function give_up(server, reason)
    -- Another try would not help.
    server.asked = true
    server.kill()
    vim.notify(('wedm: %s %s'):format(server.program, reason), vim.log.levels.ERROR)
end

-- Looks after the server of a client from its start on.
function M.watch(client)
    if not client then
        return
    end
    local stop, command = client.stop, client.config.cmd
    local server = { program = type(command) == 'table' and command[1] or 'the server' }
    servers[client.id] = server
    function server.kill()
        if vim.fn.has('nvim-0.11') == 1 then
            stop(client, true)
        else
            stop(true)
        end
    end
    -- Whoever ends it on purpose does so by this.
    client.stop = function(...)
        server.asked = true
        return stop(...)
    end
    vim.defer_fn(function()
        if servers[client.id] == server and not server.ready and not server.asked then
            give_up(server, ('does not answer: there was nothing within %g s; the option `cmd` chooses another program'):format(M.patience / 1000))
        end
    end, M.patience)
end

-- The server has answered `initialize`. One of another version is ended.
function M.answered(client, answer)
    local server = servers[client.id]
    if not server then
        return
    end
    server.ready = loop.now()
    local spoken = vim.tbl_get(answer or {}, 'capabilities', 'experimental', 'wedm', 'protocol')
    if spoken == nil then
        give_up(server, 'is not wedm: it names no protocol of wedm; the option `cmd` chooses another program')
    elseif spoken ~= protocol then
        give_up(server, ('speaks protocol %s of wedm, these files speak %d: update %s'):format(
            tostring(spoken), protocol, tonumber(spoken) and spoken > protocol and 'these files' or 'the server'))
    end
end

-- Neovim could not read or handle something. What is no message ends the server that wrote it; where Neovim does not say which one it was
-- (`client_id` is nil), it ends them all.
function M.erred(code, client_id)
    if not babble[vim.lsp.rpc.client_errors[code]] then
        return
    end
    for id, server in pairs(servers) do
        if id == (client_id or id) then
            server.babbled = true
            server.kill()
        end
    end
end

-- The pause after the end of a server in ms, nil where it is not started again; tells the user, except of a restart at once.
function M.after(client_id, code, signal)
    local server = servers[client_id] or {}
    servers[client_id] = nil
    if server.asked then
        return nil
    end
    local pause = after_life_of(server.ready and loop.now() - server.ready or 0)
    local how = server.babbled and 'after it wrote what is no message' or signal ~= 0 and 'by signal ' .. signal or 'with code ' .. code
    if not pause then
        vim.notify(('wedm has ended %d times in a row, the last time %s, and is not started again before :edit; its log: %s'):format(
            #pauses + 1, how, require('vim.lsp.log').get_filename()), vim.log.levels.ERROR)
    elseif pause > 0 then
        vim.notify(('wedm has ended %s and is started again in %g s'):format(how, pause / 1000), vim.log.levels.WARN)
    end
    return pause
end

return M
