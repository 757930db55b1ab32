// Types of Qt in messages, and what stands for them in JSON.
#pragma once

#include "protocol/generated/messages.h"

#include <array>

namespace lampblack::protocol
{

/// A digest is hexadecimal.
template <class Fields, class... Rule>
void text(Fields& fields, const char* name, QByteArray& value, const Rule&... rule)
{
    QString text = QString::fromLatin1(value);
    fields.text(name, text, rule...);
    value = text.toLatin1();
}

/// An affine transform is a 2 x 3 matrix, row by row.
template <class Fields, class... Rule>
void reals(Fields& fields, const char* name, QTransform& value, const Rule&... rule)
{
    std::array<double, 6> rows = {value.m11(), value.m21(), value.dx(), value.m12(), value.m22(), value.dy()};
    fields.reals(name, rows, rule...);
    value = QTransform(rows[0], rows[3], rows[1], rows[4], rows[2], rows[5]);
}

template <class Fields, class... Rule>
void object(Fields& fields, const char* name, QRectF& value, const Rule&... rule)
{
    Crop crop = {value.x(), value.y(), value.width(), value.height()};
    fields.object(name, crop, rule...);
    value = QRectF(crop.x, crop.y, crop.width, crop.height);
}

} // namespace lampblack::protocol
