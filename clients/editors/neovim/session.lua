-- One session as a user has it: open the drawing given, wait for its fault, take the offered fix, see it clean, write; then undo, kill
-- the server, and see the fault again from the one that is started in its place.
-- Prints one line for each thing seen; a line that begins with FAIL ends the session with an error.

local native = vim.env.WEDM_NATIVE == '1'
local folder = vim.env.WEDM_CONFIGURATION

local function say(line)
    io.stdout:write(line .. '\n')
end

local function wait_for(what, condition)
    if not vim.wait(90000, condition, 20) then
        say('FAIL no ' .. what .. ' within 90 s')
        vim.cmd('cquit 1')
    end
end

-- What the README says, word for word.
if native then
    vim.opt.runtimepath:append(folder)
    vim.lsp.config('wedm', { settings = { wedm = { correction = 0.1 } } })
    vim.lsp.enable('wedm')
    -- `-u NONE` leaves out what a user has on: types of files, and what the folder adds to them.
    vim.cmd('filetype on')
    vim.cmd('runtime! ftdetect/wedm.lua')
else
    vim.opt.runtimepath:append(folder)
    require('wedm').setup { settings = { correction = 0.1 } }
end

local function faults()
    return vim.diagnostic.get(0, { severity = vim.diagnostic.severity.ERROR })
end

local function session()
    vim.cmd('edit ' .. vim.fn.fnameescape(vim.env.WEDM_DRAWING))
    wait_for('diagnostic', function() return #faults() > 0 end)
    local fault = faults()[1]
    say(('diagnostic line %d: %s'):format(fault.lnum + 1, fault.message))
    say('text there: ' .. vim.trim(vim.fn.getline(fault.lnum + 1)))
    vim.api.nvim_win_set_cursor(0, { fault.lnum + 1, fault.col })

    -- The user picks the first action of the menu.
    vim.ui.select = function(items, _, choose)
        for _, item in ipairs(items) do
            local action = item[2] or item.action or item
            say('offered: ' .. action.title)
        end
        choose(items[1], 1)
    end
    vim.lsp.buf.code_action()
    wait_for('fix', function() return #faults() == 0 end)
    vim.cmd('write')
    say('fixed and written')
    vim.cmd('undo')
    wait_for('fault after undo', function() return #faults() == 1 end)

    -- An edit is undone while the fix that was asked for it is on its way. The server is held up so that it is.
    local function signal(name)
        vim.fn.system { 'kill', '-' .. name, vim.fn.trim(vim.fn.system { 'pgrep', '-P', tostring(vim.fn.getpid()) }) }
    end
    local before = vim.api.nvim_buf_get_lines(0, 0, -1, false)
    vim.api.nvim_buf_set_lines(0, fault.lnum - 4, fault.lnum - 3, false, { '19.94' })
    wait_for('other fault', function() return #faults() == 1 and faults()[1].message ~= fault.message end)
    vim.api.nvim_win_set_cursor(0, { fault.lnum + 1, fault.col })
    local answered, choose_first, notify = false, vim.ui.select, vim.notify
    vim.ui.select = function(items, options, choose)
        choose_first(items, options, choose)
        answered = true
    end
    vim.notify = function(text, ...)
        answered = true
        return notify(text, ...)
    end
    signal('STOP')
    vim.lsp.buf.code_action()
    vim.cmd('undo')
    signal('CONT')
    wait_for('answer to what was asked before the undo', function() return answered end)
    wait_for('fault as it was', function() return #faults() == 1 and faults()[1].message == fault.message end)
    vim.ui.select, vim.notify = choose_first, notify
    if not vim.deep_equal(before, vim.api.nvim_buf_get_lines(0, 0, -1, false)) then
        say('FAIL a fix for another text was made')
        vim.cmd('cquit 1')
    end
    say('a fix that undo has overtaken changed nothing')

    local function server()
        local clients = native and vim.lsp.get_clients { name = 'wedm' } or vim.lsp.get_active_clients()
        return clients[1]
    end
    local first = server().id
    vim.fn.system { 'kill', '-9', vim.fn.trim(vim.fn.system { 'pgrep', '-P', tostring(vim.fn.getpid()) }) }
    wait_for('end of the server', function() return not server() or server().id ~= first end)
    -- An edit while there is no server: the one that is started in its place must know of it.
    vim.cmd('redo')
    wait_for('new server', function() return server() and server().initialized ~= false and server().id ~= first end)
    wait_for('drawing that is clean', function() return #faults() == 0 end)
    vim.cmd('undo')
    wait_for('fault from the new server', function() return #faults() == 1 end)
    say('the server was killed and started again: ' .. #faults() .. ' fault')
    vim.cmd('qall!')
end

-- Not before Neovim has started as it does for a user.
vim.api.nvim_create_autocmd('VimEnter', {
    nested = true,
    callback = function()
        local ok, reason = pcall(session)
        if not ok then
            say('FAIL ' .. tostring(reason))
            vim.cmd('cquit 1')
        end
    end,
})
