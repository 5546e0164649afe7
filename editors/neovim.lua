-- SPDX-FileCopyrightText: 2026 The Keyline Authors
-- SPDX-License-Identifier: Apache-2.0
-- Starts `keyline lsp` for graph files: JSON that has a "keyline" in its first lines.  Other JSON is left alone.
--
--     dofile("/path/to/keyline/editors/neovim.lua")
--
-- in init.lua.  $KEYLINE is the program, where it is not in $PATH.

local command = { os.getenv("KEYLINE") or "keyline", "lsp" }

local function is_graph(buffer)
  for _, line in ipairs(vim.api.nvim_buf_get_lines(buffer, 0, 20, false)) do
    if line:find('"keyline"%s*:') then return true end
  end
  return false
end

-- Neovim 0.7 has no vim.lsp.start.
local function start(config, buffer)
  if vim.lsp.start then return vim.lsp.start(config) end
  vim.lsp.buf_attach_client(buffer, vim.lsp.start_client(config))
end

vim.api.nvim_create_autocmd("FileType", {
  pattern = { "json", "jsonc" },
  callback = function(args)
    if not is_graph(args.buf) then return end
    start({ name = "keyline", cmd = command, root_dir = vim.fn.expand("%:p:h") }, args.buf)
  end,
})
