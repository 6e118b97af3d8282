-- The server's program.

local M = {}

-- On the PATH, or where `cargo install` puts it. A desktop often starts programs with another PATH than a shell has.
function M.find()
    local own = vim.fn.expand('~/.cargo/bin/wedm')
    return vim.fn.executable('wedm') == 0 and vim.fn.executable(own) == 1 and own or 'wedm'
end

-- Whether there is such a program; if not, the user is told how to get it.
function M.is_there(command)
    if vim.fn.executable(command) == 1 then
        return true
    end
    vim.notify('wedm: ' .. command .. ' is neither on the PATH nor in ~/.cargo/bin; build it in a checkout of wedm with: cargo install --path .',
        vim.log.levels.WARN)
    return false
end

return M
