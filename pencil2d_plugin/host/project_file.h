// A small Pencil2D project of one bitmap layer: the form in which Pencil2D takes a layer in.
#pragma once

#include <QByteArray>
#include <QImage>
#include <QPoint>
#include <QString>

namespace lampblack
{

/// What shows in an image: cut to its opaque part. The corner is from the canvas's centre, where Pencil2D
/// has its origin. Nothing drawn: one transparent pixel.
struct Cel
{
    QImage image;
    QPoint corner;
};

/// Cut an image whose origin lies at `origin`, in its own pixels. Pencil2D 0.6 moves key frames with
/// transparent margins each time the project is saved.
Cel cut(const QImage& image, const QPoint& origin);

/// Written key frame by key frame into `folder`, in the old format ("layer.pcl" with a folder beside it),
/// which needs no zip. Pencil2D may read the files again later: they are to stay while it runs.
class ProjectFile
{
public:
    explicit ProjectFile(const QString& folder);

    /// False if the file cannot be written.
    bool addKey(int frame, const Cel& cel);
    bool finish(const QString& layer);

    QString path() const;
    int keys() const { return mCount; }

private:
    QString mFolder;
    QByteArray mKeys;
    int mCount = 0;
};

} // namespace lampblack
