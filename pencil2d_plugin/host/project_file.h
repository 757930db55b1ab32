// A Pencil2D project with one bitmap layer: Pencil2D imports layers from project files.
#pragma once

#include <QByteArray>
#include <QImage>
#include <QPoint>
#include <QString>

namespace lampblack
{

/// The opaque part of an image, or one transparent pixel if nothing is drawn. `corner` is its top left corner
/// in Pencil2D's coordinates, whose origin is the centre of the canvas.
struct Cel
{
    QImage image;
    QPoint corner;
};

/// Crop an image whose pixel `origin` is Pencil2D's origin. Needed because Pencil2D 0.6 moves key frames that
/// have transparent margins each time the project is saved.
Cel cut(const QImage& image, const QPoint& origin);

/// Writes key frame by key frame into `folder`, in the old format ("layer.pcl" and a data folder), which
/// needs no zip. The files must stay while Pencil2D runs, because it may read them again.
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
