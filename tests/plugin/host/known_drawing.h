// A project with known pixels, written as Pencil2D stores it.
#pragma once

#include <QBuffer>
#include <QColor>
#include <QFile>
#include <QImage>
#include <QPainter>
#include <QtEndian>

namespace known
{

constexpr int Frames = 3;
const QSize Canvas(641, 481);   ///< odd, to tell halves from whole pixels
const QPoint Corner(-120, -90); ///< of the colours, from the canvas's centre
const QSize Colours(300, 200);

struct Mark
{
    QRect rect; ///< in the colours' own pixels
    QColor colour;
};

/// Squares to find again in a view; no two of one colour.
inline QVector<Mark> marks()
{
    return {{{0, 0, 20, 20}, QColor(255, 0, 0)},
            {{280, 0, 20, 20}, QColor(0, 255, 0)},
            {{0, 180, 20, 20}, QColor(0, 0, 255)}};
}

inline QImage colours(int frame)
{
    QImage image(Colours, QImage::Format_ARGB32);
    image.fill(Qt::transparent);
    QPainter painter(&image);
    for (const Mark& mark : marks())
        painter.fillRect(mark.rect, mark.colour);
    painter.fillRect(QRect(100, 60, 80 + 10 * frame, 60), QColor(200, 120, 40));
    return image;
}

inline QImage ink(int)
{
    QImage image(40, 40, QImage::Format_ARGB32);
    image.fill(QColor(0, 0, 0));
    return image;
}

inline QPoint inkCorner(int frame)
{
    return {10 * frame, 0};
}

/// What an export must be, to the pixel.
inline QImage exported(int frame, bool withInk)
{
    QImage image(Canvas, QImage::Format_RGBA8888);
    image.fill(Qt::transparent);
    QPainter painter(&image);
    painter.translate(Canvas.width() / 2, Canvas.height() / 2);
    painter.drawImage(Corner, colours(frame));
    if (withInk)
        painter.drawImage(inkCorner(frame), ink(frame));
    return image;
}

/// Centre of a mark in canvas pixels from the top left corner.
inline QPointF centre(const Mark& mark)
{
    return QRectF(mark.rect).center() + Corner + QPoint(Canvas.width() / 2, Canvas.height() / 2);
}

/// A zip of stored entries, which is what a .pclx is.
class Zip
{
public:
    void add(const QByteArray& name, const QByteArray& content)
    {
        const QByteArray sums = le32(crc(content)) + le32(quint32(content.size())) +
                                le32(quint32(content.size())) + le16(quint16(name.size()));
        const QByteArray head = le16(20) + le16(0) + le16(0) + le32(0x58210000);
        mDirectory += QByteArray("PK\x01\x02") + le16(20) + head + sums + le16(0) + le16(0) + le16(0) +
                      le16(0) + le32(0) + le32(quint32(mFiles.size())) + name;
        mFiles += QByteArray("PK\x03\x04") + head + sums + le16(0) + name + content;
        ++mCount;
    }

    bool write(const QString& path) const
    {
        QFile file(path);
        const QByteArray end = QByteArray("PK\x05\x06") + le32(0) + le16(mCount) + le16(mCount) +
                               le32(quint32(mDirectory.size())) + le32(quint32(mFiles.size())) + le16(0);
        return file.open(QFile::WriteOnly) && file.write(mFiles + mDirectory + end) > 0;
    }

private:
    template <class T> static QByteArray le(T value)
    {
        QByteArray bytes(sizeof(T), '\0');
        qToLittleEndian(value, bytes.data());
        return bytes;
    }
    static QByteArray le16(quint16 value) { return le(value); }
    static QByteArray le32(quint32 value) { return le(value); }

    static quint32 crc(const QByteArray& bytes)
    {
        quint32 sum = ~0U;
        for (const char byte : bytes)
        {
            sum ^= quint8(byte);
            for (int bit = 0; bit < 8; ++bit)
                sum = (sum >> 1) ^ ((sum & 1U) != 0 ? 0xEDB88320U : 0U);
        }
        return ~sum;
    }

    QByteArray mFiles;
    QByteArray mDirectory;
    quint16 mCount = 0;
};

inline QByteArray png(const QImage& image)
{
    QBuffer buffer;
    buffer.open(QBuffer::WriteOnly);
    image.save(&buffer, "PNG");
    return buffer.data();
}

/// Layers, top first: "Ink", "Colours", "Song", "Path", "Film". `camera` is the camera's key frames.
inline bool writeProject(const QString& path, const QByteArray& camera)
{
    Zip zip;
    QByteArray colourKeys;
    QByteArray inkKeys;
    const auto key = [](const QByteArray& file, int frame, const QPoint& at)
    {
        return QStringLiteral(
                   "<image frame=\"%1\" src=\"%2\" topLeftX=\"%3\" topLeftY=\"%4\" opacity=\"1\"/>")
            .arg(frame)
            .arg(QString::fromLatin1(file))
            .arg(at.x())
            .arg(at.y())
            .toUtf8();
    };
    for (int frame = 1; frame <= Frames; ++frame)
    {
        const QByteArray number = QByteArray::number(frame).rightJustified(3, '0');
        zip.add("data/003." + number + ".png", png(colours(frame)));
        zip.add("data/004." + number + ".png", png(ink(frame)));
        colourKeys += key("003." + number + ".png", frame, Corner);
        inkKeys += key("004." + number + ".png", frame, inkCorner(frame));
    }
    zip.add("main.xml",
            "<!DOCTYPE PencilDocument><document><projectdata><currentFrame value=\"1\"/>"
            "<currentLayer value=\"3\"/><fps value=\"12\"/></projectdata><object>"
            "<layer id=\"1\" name=\"Film\" visibility=\"1\" type=\"5\" width=\"641\" height=\"481\">" +
                camera +
                "</layer><layer id=\"2\" name=\"Path\" visibility=\"1\" type=\"2\"/>"
                "<layer id=\"5\" name=\"Song\" visibility=\"1\" type=\"4\"/>"
                "<layer id=\"3\" name=\"Colours\" visibility=\"1\" type=\"1\">" +
                colourKeys + "</layer><layer id=\"4\" name=\"Ink\" visibility=\"1\" type=\"1\">" + inkKeys +
                "</layer></object><version>0.6.6</version></document>");
    return zip.write(path);
}

const QByteArray StillCamera = "<camera frame=\"1\" r=\"0\" s=\"1\" dx=\"0\" dy=\"0\"/>";
/// It turns, shrinks, and in Pencil2D 0.7 eases along a curve.
const QByteArray MovingCamera =
    "<camera frame=\"1\" r=\"10\" s=\"0.9\" dx=\"30\" dy=\"-12\" easing=\"3\" pathCPX=\"20\" pathCPY=\"60\"/>"
    "<camera frame=\"4\" r=\"50\" s=\"0.7\" dx=\"60\" dy=\"20\"/>";
/// It moves over many frames.
constexpr int LongMove = 150;
const QByteArray LongCamera = "<camera frame=\"1\" r=\"0\" s=\"1\" dx=\"0\" dy=\"0\"/><camera frame=\"" +
                              QByteArray::number(LongMove) + "\" r=\"0\" s=\"1\" dx=\"149\" dy=\"0\"/>";

} // namespace known
