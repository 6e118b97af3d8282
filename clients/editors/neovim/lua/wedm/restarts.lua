-- How often a server that ends is started again, and after what pause: "When the server ends" in docs/protocol.md.

local M = {}

-- ms
local pauses = { 0, 500, 1000, 2000, 4000 }
-- After a server that has lived this long, the count of ends in a row begins again.
local sound_life = 60000
local loop = vim.uv or vim.loop

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
local ready = {} -- client id -> when it had answered

function M.answered(client_id)
    ready[client_id] = loop.now()
end

-- The pause after the end of a server in ms, nil where it is not started again; tells the user, except of a restart at once.
function M.after(client_id, code, signal)
    local pause = after_life_of(ready[client_id] and loop.now() - ready[client_id] or 0)
    ready[client_id] = nil
    local how = signal ~= 0 and 'by signal ' .. signal or 'with code ' .. code
    if not pause then
        vim.notify(('wedm has ended %d times in a row, the last time %s, and is not started again before :edit; its log: %s'):format(
            #pauses + 1, how, require('vim.lsp.log').get_filename()), vim.log.levels.ERROR)
    elseif pause > 0 then
        vim.notify(('wedm has ended %s and is started again in %g s'):format(how, pause / 1000), vim.log.levels.WARN)
    end
    return pause
end

return M
