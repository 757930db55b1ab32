#include "host/project_file.h"

#include <QDir>
#include <QFile>

namespace lampblack
{

namespace
{

constexpr int QuickPng = 80; ///< Qt's scale, 100 is uncompressed

QRect opaquePart(const QImage& image)
{
    QRect part;
    for (int y = 0; y < image.height(); ++y)
    {
        const auto* row = reinterpret_cast<const QRgb*>(image.constScanLine(y));
        int left = 0;
        while (left < image.width() && qAlpha(row[left]) == 0)
            ++left;
        if (left == image.width())
            continue;
        int right = image.width() - 1;
        while (qAlpha(row[right]) == 0)
            --right;
        part |= QRect(left, y, right - left + 1, 1);
    }
    return part;
}

QString fileOf(int frame)
{
    return QStringLiteral("001.%1.png").arg(frame, 3, 10, QLatin1Char('0'));
}

} // namespace

Cel cut(const QImage& image, const QPoint& origin)
{
    const QImage straight = image.convertToFormat(QImage::Format_ARGB32);
    QRect part = opaquePart(straight);
    if (part.isEmpty())
        part = QRect(origin, QSize(1, 1)); // outside an image, copy() is transparent
    return {straight.copy(part), part.topLeft() - origin};
}

ProjectFile::ProjectFile(const QString& folder) : mFolder(folder)
{
}

QString ProjectFile::path() const
{
    return QDir(mFolder).filePath(QStringLiteral("layer.pcl"));
}

bool ProjectFile::addKey(int frame, const Cel& cel)
{
    const QDir data(path() + QStringLiteral(".data"));
    if (!data.mkpath(QStringLiteral(".")) || !cel.image.save(data.filePath(fileOf(frame)), "PNG", QuickPng))
    {
        return false;
    }
    mKeys += QStringLiteral("<image frame=\"%1\" src=\"%2\" opacity=\"1\" topLeftX=\"%3\" topLeftY=\"%4\"/>")
                 .arg(frame)
                 .arg(fileOf(frame))
                 .arg(cel.corner.x())
                 .arg(cel.corner.y())
                 .toUtf8();
    ++mCount;
    return true;
}

bool ProjectFile::finish(const QString& layer)
{
    const QString begin = QStringLiteral("<!DOCTYPE PencilDocument><document><object>"
                                         "<layer id=\"1\" type=\"1\" name=\"%1\" visibility=\"1\">");
    const QByteArray text = begin.arg(layer.toHtmlEscaped()).toUtf8() + mKeys +
                            "</layer></object><version>0.6.6</version></document>";
    QFile file(path());
    return file.open(QFile::WriteOnly) && file.write(text) == text.size();
}

} // namespace lampblack
