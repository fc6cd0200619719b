// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
