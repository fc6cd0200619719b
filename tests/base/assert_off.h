// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

/// How often the expressions and values of two assertions are evaluated where assertions are off.
int evaluations_without_assertions();
