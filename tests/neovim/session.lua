-- One session as a user has it: open the drawing given, wait for its fault, take the offered fix, see it clean, write.
-- Prints one line for each thing seen; a line that begins with FAIL ends the session with an error.

local wedm = dofile(vim.env.WEDM_LUA)
wedm.setup { cmd = { vim.env.WEDM }, settings = { correction = 0.1 } }

local function say(line)
    io.stdout:write(line .. '\n')
end

local function wait_for(what, condition)
    if not vim.wait(20000, condition, 20) then
        say('FAIL no ' .. what .. ' within 20 s')
        vim.cmd('cquit 1')
    end
end

vim.cmd('edit ' .. vim.fn.fnameescape(vim.env.WEDM_DRAWING))
local function faults()
    local found = {}
    for _, diagnostic in ipairs(vim.diagnostic.get(0)) do
        if diagnostic.severity == vim.diagnostic.severity.ERROR then
            found[#found + 1] = diagnostic
        end
    end
    return found
end

wait_for('diagnostic', function() return #faults() > 0 end)
local fault = faults()[1]
say(('diagnostic line %d: %s'):format(fault.lnum + 1, fault.message))
say('text there: ' .. vim.trim(vim.fn.getline(fault.lnum + 1)))
vim.api.nvim_win_set_cursor(0, { fault.lnum + 1, fault.col })

-- The user picks the first action of the menu.
vim.ui.select = function(items, options, choose)
    for _, item in ipairs(items) do
        local action = item[2] or item.action or item
        say('offered: ' .. action.title)
    end
    choose(items[1], 1)
end
local before = #faults()
vim.lsp.buf.code_action()
wait_for('fix', function() return #faults() < before end)
say(('faults: %d, then %d'):format(before, #faults()))
vim.cmd('write')
say('written')
vim.cmd('undo')
wait_for('fault after undo', function() return #faults() == before end)
say(('after undo: %d'):format(#faults()))
vim.cmd('qall!')
