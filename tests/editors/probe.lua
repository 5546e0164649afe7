-- SPDX-FileCopyrightText: 2026 The Keyline Authors
-- SPDX-License-Identifier: Apache-2.0
-- What Neovim shows of $GRAPH: a line for each diagnostic, and for each word offered inside "hero.Com".
local waiting = 60000

local function offers(line, column)
  local at = { textDocument = vim.lsp.util.make_text_document_params(), position = { line = line, character = column } }
  for _, answer in pairs(vim.lsp.buf_request_sync(0, "textDocument/completion", at, waiting) or {}) do
    for _, item in ipairs(answer.result.items or answer.result) do print("offered: " .. item.label .. "\n") end
  end
end

vim.cmd("edit " .. os.getenv("GRAPH"))
vim.wait(waiting, function() return #vim.diagnostic.get(0) > 1 end)
for _, d in ipairs(vim.diagnostic.get(0)) do print("told: " .. (d.lnum + 1) .. ": " .. d.message .. "\n") end
offers(4, 45)
offers(6, 89)
vim.cmd("edit! " .. os.getenv("OTHER"))
vim.wait(500)
print("clients of other JSON: " .. #vim.lsp.buf_get_clients(0) .. "\n")
vim.cmd("qa!")
